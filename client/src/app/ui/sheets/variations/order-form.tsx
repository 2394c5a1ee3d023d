import { useSignal } from "@preact/signals";
import { BOUNDS } from "../../../../wire/generated";
import { type ExportChoice, FIRST_CHOICE, isExportChoice, optionsOf } from "../../../library/export-choice";
import type { Jobs } from "../../../library/variations/jobs";
import {
  FIRST_WISH,
  lastSeed,
  MOST_TREES,
  mostFirst,
  orderOf,
  type Pattern,
  UNTIL,
  type Until,
  type Wish,
} from "../../../library/variations/order";
import { kept } from "../../../page/settings";
import { sentence } from "../../../problems/plain-words";
import { type Key, say } from "../../../words/say";
import { Segments } from "../../controls/segments";
import { TypedNumber } from "../../controls/typed-number";
import { ExportOptions, useFormats } from "../export-options";
import { TreePicture } from "../tree-picture";

/** More than any server grows; it says itself how many it does. */
const MOST_METAMERS = 9_999_999;

/** What was ordered last on this device. */
const choice = kept<ExportChoice>(
  localStorage,
  "variations-format",
  { ...FIRST_CHOICE, format: "glb" },
  isExportChoice,
);

interface OrderFormProps {
  readonly jobs: Jobs;
  readonly pattern: Pattern;
}

/** How many trees, how far they are grown, and as what they are written. */
export function OrderForm({ jobs, pattern }: OrderFormProps) {
  // Read at once where it is sent, for a number is typed until the very key that sends it.
  const wish = useSignal<Wish>(FIRST_WISH);
  const trouble = useSignal<unknown>(null);
  const [formats, askAgain] = useFormats();
  const set = (part: Partial<Wish>) => {
    const next = { ...wish.peek(), ...part };
    wish.value = { ...next, first: Math.min(next.first, mostFirst(next.trees)) };
  };
  const format = formats?.find(({ ending }) => ending === choice.value.format) ?? formats?.[0];
  const { trees, first, until, steps, metamers } = wish.value;
  const ordering = jobs.ordering.value;

  const order = async (event: Event) => {
    event.preventDefault();
    if (format === undefined) {
      return;
    }
    trouble.value = null;
    try {
      const wanted = orderOf(pattern, wish.peek(), format.ending, optionsOf(choice.peek(), format));
      const job = await jobs.order(wanted, pattern.name);
      if (job !== null) {
        requestAnimationFrame(() => document.getElementById(`job-${job.id}`)?.scrollIntoView({ block: "nearest" }));
      }
    } catch (error) {
      trouble.value = error;
    }
  };

  return (
    <form class="stack order-form" onSubmit={(event) => void order(event)}>
      <div class="order-pattern">
        <TreePicture url={pattern.picture} />
        <p class="quiet">{say("variations.advice")}</p>
      </div>
      <NumberRow
        label={say("variations.trees")}
        least={1}
        most={MOST_TREES}
        value={trees}
        onCommit={(trees) => set({ trees })}
      />
      <NumberRow
        label={say("variations.first")}
        least={0}
        most={mostFirst(trees)}
        value={first}
        onCommit={(first) => set({ first })}
      />
      <Segments
        legend={say("variations.until")}
        name="until"
        values={UNTIL}
        chosen={until}
        text={(until) => say(`variations.until.${until}` as Key)}
        onChoose={(until) => set({ until: until as Until })}
      />
      {until === "steps" && (
        <NumberRow
          label={say("variations.steps")}
          least={BOUNDS.Steps.least}
          most={BOUNDS.Steps.most}
          value={steps}
          onCommit={(steps) => set({ steps })}
        />
      )}
      {until === "metamers" && (
        <NumberRow
          label={say("variations.metamers")}
          least={1}
          most={MOST_METAMERS}
          value={metamers}
          onCommit={(metamers) => set({ metamers })}
        />
      )}
      {formats === undefined && <p class="quiet">{say("notices.looking")}</p>}
      {formats === null && (
        <p class="quiet">
          {say("exports.lost")}{" "}
          <button type="button" class="small" onClick={askAgain}>
            {say("exports.again")}
          </button>
        </p>
      )}
      {formats && format && (
        <>
          <Segments
            legend={say("sheets.download.format")}
            name="variations-format"
            values={formats.map(({ ending }) => ending)}
            chosen={format.ending}
            text={(ending) => say(formats.find((format) => format.ending === ending)?.label ?? [ending, ending])}
            onChoose={(format) => {
              choice.value = { ...choice.peek(), format };
            }}
          />
          <p class="quiet">{say(format.text)}</p>
          <ExportOptions
            format={format}
            choice={choice.value}
            choose={(part) => {
              choice.value = { ...choice.peek(), ...part };
            }}
          />
        </>
      )}
      {trouble.value !== null && (
        <p class="warning" role="alert">
          {sentence(trouble.value)}
        </p>
      )}
      <div class="actions">
        <p class="quiet">{trees > 1 && say("variations.seeds", { first, last: lastSeed(wish.value) })}</p>
        <button type="submit" class="primary" disabled={ordering || format === undefined}>
          {say(ordering ? "variations.acting" : "variations.act")}
        </button>
      </div>
    </form>
  );
}

interface NumberRowProps {
  readonly label: string;
  readonly least: number;
  readonly most: number;
  readonly value: number;
  readonly onCommit: (value: number) => void;
}

/** A whole number that is typed. */
function NumberRow({ label, ...number }: NumberRowProps) {
  return (
    <div class="number-row">
      <span aria-hidden="true">{label}</span>
      <TypedNumber label={label} unit="" step={1} {...number} />
    </div>
  );
}
