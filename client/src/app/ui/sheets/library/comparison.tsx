import type { TreeVersion } from "../../../../wire/generated";
import { timeBetween } from "../../../library/time-between";
import { language, say } from "../../../words/say";
import { TreePicture } from "../tree-picture";
import { type VersionDeeds, VersionFacts } from "./version-card";

interface ComparisonProps {
  readonly older: TreeVersion;
  readonly newer: TreeVersion;
  readonly deeds: VersionDeeds;
}

/** Two versions side by side, and what lies between them. */
export function Comparison({ older, newer, deeds }: ComparisonProps) {
  const grown = newer.metamers - older.metamers;
  return (
    <section class="comparison" aria-label={say("library.compare")}>
      <p class="comparison-between">
        {say("library.between", {
          time: timeBetween(older.saved_at, newer.saved_at),
          count: grown.toLocaleString(language.value, { signDisplay: "exceptZero" }),
        })}
      </p>
      {[older, newer].map((version) => (
        <figure key={version.number}>
          <TreePicture url={version.thumbnail} />
          <figcaption>
            <VersionFacts version={version} />
            <button type="button" class="small" onClick={() => deeds.open(version)}>
              {say("library.open-version", { number: version.number })}
            </button>
          </figcaption>
        </figure>
      ))}
    </section>
  );
}
