import { useEffect, useMemo, useState } from "preact/hooks";
import type { SavedTree, TreeVersion } from "../../../../wire/generated";
import { changeVersion, copyTree, listVersions, restoreVersion } from "../../../library/library-api";
import { Pages } from "../../../library/pages";
import { said } from "../../../library/save-tree";
import { sentence } from "../../../problems/plain-words";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { Comparison } from "./comparison";
import { More } from "./more";
import { VersionCard, type VersionDeeds } from "./version-card";

/** Two versions can be compared. */
const PAIR = 2;

/** All versions of a tree: to look at, compare, go back to, and branch from. */
export function VersionsSheet({ studio }: { studio: Studio }) {
  const tree = studio.layout.subject.value;
  return tree === null ? null : <Versions key={tree.id} studio={studio} tree={tree} />;
}

function Versions({ studio, tree }: { readonly studio: Studio; readonly tree: SavedTree }) {
  const pages = useMemo(
    () =>
      new Pages<TreeVersion>(
        (limit, before) => listVersions(tree.id, limit, before),
        ({ number }) => number,
      ),
    [tree.id],
  );
  const [ticked, setTicked] = useState<readonly number[]>([]);
  const [comparing, setComparing] = useState(false);
  useEffect(() => void pages.next(), [pages]);
  const versions = pages.items.value ?? [];
  const pair = versions.filter(({ number }) => ticked.includes(number));
  const deeds = deedsOf(studio, tree, pages);
  const [newer, older] = pair;
  return (
    <div class="library-sections">
      <div class="library-bar">
        <button
          type="button"
          class="small"
          onClick={() => {
            if (comparing) {
              setComparing(false);
            } else {
              studio.layout.sheet.value = "library";
            }
          }}
        >
          {say(comparing ? "library.to-versions" : "library.to-library")}
        </button>
        <strong class="library-title">{tree.name}</strong>
        {!comparing && (
          <button
            type="button"
            class="small"
            disabled={pair.length < PAIR}
            title={say("library.compare.how")}
            onClick={() => setComparing(true)}
          >
            {say("library.compare")}
          </button>
        )}
      </div>
      {comparing && newer && older ? (
        <Comparison studio={studio} tree={tree.id} older={older} newer={newer} deeds={deeds} />
      ) : (
        <>
          {versions.length > 1 && pair.length < PAIR && <p class="quiet">{say("library.compare.how")}</p>}
          <ul class="versions">
            {versions.map((version, i) => (
              <VersionCard
                key={version.number}
                rights={studio.rights}
                version={version}
                isNewest={i === 0}
                isTicked={ticked.includes(version.number)}
                onTick={versions.length > 1 ? () => setTicked(tick(ticked, version.number)) : undefined}
                deeds={deeds}
              />
            ))}
          </ul>
          <More pages={pages} />
        </>
      )}
    </div>
  );
}

/** One more is ticked, or no longer; of three the first one is let go. */
function tick(ticked: readonly number[], number: number): readonly number[] {
  return ticked.includes(number) ? ticked.filter((other) => other !== number) : [...ticked, number].slice(-PAIR);
}

/** What can be done with a version. */
function deedsOf(studio: Studio, tree: SavedTree, pages: Pages<TreeVersion>): VersionDeeds {
  const attempt = async (work: () => Promise<void>) => {
    try {
      await work();
    } catch (error) {
      studio.toasts.show(sentence(error));
    }
  };
  return {
    open: ({ number }) => void studio.trees.leave({ tree, version: number }),
    restore: ({ number }) =>
      void attempt(async () => {
        const restored = await restoreVersion(tree.id, number, said(studio));
        pages.begin(restored);
        studio.toasts.show(say("library.restored", { number, version: restored.number }), {
          label: say("library.open"),
          act: () => void studio.trees.leave({ tree }),
        });
      }),
    branch: ({ number }) =>
      void attempt(async () => {
        const name = say("library.branch-of", { name: tree.name, number });
        const branch = await copyTree(tree.id, { name, version: number, ...said(studio) });
        studio.toasts.show(say("library.branched", { name: branch.name }), {
          label: say("library.open"),
          act: () => void studio.trees.leave({ tree: branch }),
        });
      }),
    note: ({ number }, note) =>
      void attempt(async () => pages.replace(number, await changeVersion(tree.id, number, { note }))),
  };
}
