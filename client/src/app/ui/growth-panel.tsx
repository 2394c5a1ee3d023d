import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { Species } from "../../wire/generated";
import { type GrowthParameter, SECTIONS } from "../growth-parameters";
import { isGrown, listSpecies } from "../species-api";
import { type Studio, sentence } from "../studio";
import { LeafSketch } from "./leaf-sketch";
import { NumberField } from "./number-field";
import { Panel } from "./panel";

type Tab = "species" | "parameters";

/** Both outlast the panel: it opens as it was closed. */
const tab = signal<Tab>("species");
const species = signal<readonly Species[] | null>(null);

/** What trees grow by: a species, or each parameter by itself. */
export function GrowthPanel({ studio }: { studio: Studio }) {
  const known = species.value;
  useEffect(() => {
    if (species.peek() === null) {
      listSpecies().then(
        (all) => {
          species.value = all;
        },
        (error: unknown) => studio.toasts.show(sentence(error)),
      );
    }
  }, [studio]);
  if (known === null) {
    return (
      <Panel studio={studio} title="Growth">
        <p class="quiet advice">Looking…</p>
      </Panel>
    );
  }
  const shown = known.length === 0 ? "parameters" : tab.value;
  return (
    <Panel studio={studio} title="Growth">
      {known.length > 0 && (
        <div class="tabs" role="tablist">
          {(["species", "parameters"] as const).map((name) => (
            <button
              type="button"
              role="tab"
              key={name}
              aria-selected={shown === name}
              onClick={() => {
                tab.value = name;
              }}
            >
              {name === "species" ? "Species" : "Parameters"}
            </button>
          ))}
        </div>
      )}
      {shown === "species" ? <SpeciesList studio={studio} species={known} /> : <Parameters studio={studio} />}
    </Panel>
  );
}

function SpeciesList({ studio, species }: { studio: Studio; species: readonly Species[] }) {
  const parameters = studio.parameters.value;
  const grown = parameters === null ? undefined : species.find((one) => isGrown(one, parameters));
  return (
    <>
      <p class="quiet advice">What grows from now on follows the species picked; what has grown stays.</p>
      <ul class="species">
        {species.map((one) => (
          <li key={one.slug}>
            <button
              type="button"
              aria-pressed={one === grown}
              onClick={() => {
                studio.setParameters(one.parameters);
              }}
            >
              <LeafSketch species={one} />
              <span class="species-name">
                <b>{one.name}</b> <i>{one.botanical}</i>
              </span>
              <span class="species-sentence">{one.sentence}</span>
            </button>
          </li>
        ))}
      </ul>
    </>
  );
}

function Parameters({ studio }: { studio: Studio }) {
  if (studio.parameters.value === null) {
    return <p class="quiet">Connecting…</p>;
  }
  return (
    <>
      {SECTIONS.map(({ title, parameters }, i) => (
        <details class="section" key={title} open={i === 0} name="growth">
          <summary>{title}</summary>
          {parameters.map((parameter) => (
            <Field studio={studio} parameter={parameter} key={parameter.name} />
          ))}
        </details>
      ))}
    </>
  );
}

function Field({ studio, parameter }: { studio: Studio; parameter: GrowthParameter }) {
  const now = studio.parameters.value;
  if (now === null) {
    return null;
  }
  switch (parameter.kind) {
    case "number":
      return parameter.applies?.(now) === false ? null : <NumberField studio={studio} parameter={parameter} />;
    case "switch":
      return (
        <label class="switch spread" title={parameter.hint}>
          <span>{parameter.label}</span>
          <input
            type="checkbox"
            checked={now[parameter.name]}
            onChange={(event) => studio.setParameters({ [parameter.name]: event.currentTarget.checked })}
          />
        </label>
      );
    case "choice":
      return (
        <fieldset class="segments whole" title={parameter.hint}>
          <legend class="unseen">{parameter.label}</legend>
          {parameter.choices.map(({ value, label }) => (
            <label key={value}>
              <input
                type="radio"
                name={parameter.name}
                checked={now[parameter.name] === value}
                onChange={() => studio.setParameters({ [parameter.name]: value })}
              />
              <span>{label}</span>
            </label>
          ))}
        </fieldset>
      );
  }
}
