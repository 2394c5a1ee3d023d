import { useState } from "preact/hooks";
import type { TreeVersion } from "../../../../wire/generated";
import type { Rights } from "../../../access/rights";
import { momentText } from "../../../words/date-text";
import { language, say } from "../../../words/say";
import { TreePicture } from "../tree-picture";
import { CardForm } from "./card-form";
import { CardMenu, only } from "./card-menu";

/** What can be done with a version. */
export interface VersionDeeds {
  readonly open: (version: TreeVersion) => void;
  readonly restore: (version: TreeVersion) => void;
  readonly branch: (version: TreeVersion) => void;
  readonly note: (version: TreeVersion, note: string) => void;
}

interface VersionCardProps {
  readonly rights: Rights;
  readonly version: TreeVersion;
  readonly isNewest: boolean;
  readonly isTicked: boolean;
  /** It is to be compared, or no longer; undefined where there is none to compare it with. */
  readonly onTick: (() => void) | undefined;
  readonly deeds: VersionDeeds;
}

/** One version of a tree, with what is known of it. */
export function VersionCard({ rights, version, isNewest, isTicked, onTick, deeds }: VersionCardProps) {
  const [editing, setEditing] = useState(false);
  const { number } = version;
  const mayChange = rights.mayChange.value;
  return (
    <li class="version" data-version={number}>
      <button
        type="button"
        class="version-open"
        aria-label={say("library.open-version", { number })}
        onClick={() => deeds.open(version)}
      >
        <TreePicture url={version.thumbnail} />
      </button>
      <VersionFacts version={version} isNewest={isNewest} />
      {onTick && (
        <label class="version-tick">
          <input
            type="checkbox"
            checked={isTicked}
            aria-label={say("library.compare-version", { number })}
            onChange={onTick}
          />
        </label>
      )}
      <CardMenu
        label={say("library.more-of-version", { number })}
        deeds={[
          { label: say("library.open-it"), act: () => deeds.open(version) },
          ...only(!isNewest && mayChange, { label: say("library.restore"), act: () => deeds.restore(version) }),
          ...only(rights.mayBegin, { label: say("library.branch"), act: () => deeds.branch(version) }),
          ...only(mayChange, { label: say("library.note"), act: () => setEditing(true) }),
        ]}
      />
      {editing && (
        <CardForm
          kind="note"
          label={say("library.note-of-version", { number })}
          value={version.note}
          onSave={(note) => deeds.note(version, note)}
          onEnd={() => setEditing(false)}
        />
      )}
    </li>
  );
}

/** Number, time, author, size and note. */
export function VersionFacts({
  version,
  isNewest = false,
}: Pick<VersionCardProps, "version"> & { isNewest?: boolean }) {
  const { number, saved_at: time, author, metamers, restored, note } = version;
  const facts = [
    author,
    say("notices.metamers", { count: metamers.toLocaleString(language.value) }),
    restored === undefined ? undefined : say("library.restored-from", { number: restored }),
  ];
  return (
    <div class="version-facts">
      <strong>
        {say(isNewest ? "library.version.newest" : "library.version", { number })}
        <span class="quiet"> {momentText(time)}</span>
      </strong>
      <span class="quiet">{facts.filter(Boolean).join(" · ")}</span>
      {note !== "" && <p class="card-note">{note}</p>}
    </div>
  );
}
