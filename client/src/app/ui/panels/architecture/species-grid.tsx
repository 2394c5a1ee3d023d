import { signal } from "@preact/signals";
import { useState } from "preact/hooks";
import type { Species } from "../../../../wire/generated";
import { pictureOf } from "../../../document/species/species-api";
import { foundSpecies, speciesName, speciesSentence } from "../../../document/species/species-choice";
import { softly } from "../../../words/joints";
import { say } from "../../../words/say";
import { LeafSketch } from "./leaf-sketch";
import { sketchSettled } from "./sketch-patience";
import { kinNow, pick, useSpecies } from "./species-list";
import type { WidgetProps } from "./widget";

/** What is searched for; it outlasts the panel. */
const words = signal("");

/** The species in pictures, to pick one that trees grow as from now on. */
export function SpeciesGrid({ studio }: WidgetProps) {
  const all = useSpecies(studio);
  const kin = kinNow(studio);
  if (all === null || all.length === 0) {
    return (
      <p class="quiet advice">{say(all === null ? "architecture.species.looking" : "architecture.species.unknown")}</p>
    );
  }
  const found = foundSpecies(all, words.value);
  return (
    <>
      <p class="quiet advice">{say("architecture.species.note")}</p>
      <input
        class="species-search"
        type="search"
        aria-label={say("architecture.species.search")}
        placeholder={say("architecture.species.search")}
        autocomplete="off"
        value={words.value}
        onInput={(event) => {
          words.value = event.currentTarget.value;
        }}
        onKeyDown={(event) => {
          // The page's own keys are not for what is typed here.
          event.stopPropagation();
        }}
      />
      {found.length === 0 && (
        <p class="quiet advice" role="status">
          {say("architecture.species.none", { words: words.value })}
        </p>
      )}
      <ul class="species-grid">
        {found.map((species) => (
          <li key={species.slug}>
            <SpeciesCard
              species={species}
              state={kin?.species === species ? (kin.changed ? "changed" : "grown") : "other"}
              onPick={() => pick(studio, species)}
            />
          </li>
        ))}
      </ul>
    </>
  );
}

interface SpeciesCardProps {
  readonly species: Species;
  readonly state: "grown" | "changed" | "other";
  readonly onPick: () => void;
}

function SpeciesCard({ species, state, onPick }: SpeciesCardProps) {
  const name = speciesName(species);
  const sentence = speciesSentence(species);
  return (
    <button
      type="button"
      class="species-card"
      data-species={species.slug}
      data-state={state}
      aria-pressed={state === "grown"}
      aria-label={say("architecture.species.label", {
        name: state === "changed" ? say("architecture.changed", { name }) : name,
        botanical: species.botanical,
        sentence,
      })}
      title={sentence}
      onClick={onPick}
    >
      <SpeciesPicture species={species} />
      {state === "changed" && <span class="species-badge">{say("architecture.badge")}</span>}
      <span class="species-card-name">{softly(name)}</span>
    </button>
  );
}

/** A grown tree; a leaf while its picture is on the way, or where there is none. The sketch beside it is drawn before. */
export function SpeciesPicture({ species }: { species: Species }) {
  const [state, setState] = useState<"coming" | "there" | "none">("coming");
  return (
    <span class="species-picture" data-state={state}>
      {state !== "there" && <LeafSketch species={species} />}
      {state !== "none" && sketchSettled.value && (
        <img
          src={pictureOf(species.slug)}
          alt=""
          loading="lazy"
          decoding="async"
          draggable={false}
          onLoad={() => setState("there")}
          onError={() => setState("none")}
        />
      )}
    </span>
  );
}
