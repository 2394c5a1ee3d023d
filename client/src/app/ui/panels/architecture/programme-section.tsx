import { signal } from "@preact/signals";
import { useEffect, useState } from "preact/hooks";
import { MAX_AGE, MAX_STAGES, type Programme } from "../../../../wire/generated";
import { alike } from "../../../document/draft";
import {
  type GrowthParameter,
  NUMBERS,
  type NumberParameter,
  nameOf,
  parameterOf,
  shownValue,
} from "../../../document/growth/growth-parameters";
import { changesOf, type ProgrammeInForce } from "../../../document/growth/programme-control";
import { speciesName } from "../../../document/species/species-choice";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { TypedNumber } from "../../controls/typed-number";
import { Grip } from "./grip";
import { CurveScale, grippable, type Point, pointsOf, withChangeAt, withoutChange, withPoint } from "./programme-curve";
import { useSpecies } from "./species-list";
import { Diagram, type WidgetProps } from "./widget";

const [WIDTH, HEIGHT] = [272, 150];
const FRAME = { left: 14, top: 16, width: 244, height: 104 };

/** The parameter whose course is shown; it outlasts the panel. Without one it is the first that changes. */
const shown = signal<NumberParameter["name"] | null>(null);

/** What the tree grows by over its age, to be changed; and what was set by hand and goes before it (`PG`). */
export function ProgrammeSection({ studio }: WidgetProps) {
  const inForce = studio.programme.inForce.value;
  const now = studio.parameters.value;
  if (now === null) {
    return null;
  }
  if (inForce === null) {
    const begin = () => studio.programme.set({ parameters: now, stages: [], age: GROWN_UP });
    return (
      <div class="programme">
        <p class="quiet advice">{say("architecture.programme.none")}</p>
        <button type="button" onClick={begin}>
          {say("architecture.programme.begin")}
        </button>
      </div>
    );
  }
  return (
    <div class="programme">
      <Course studio={studio} inForce={inForce} />
      <ByHand studio={studio} inForce={inForce} />
    </div>
  );
}

/** The age at which a tree with a programme of one's own is grown up at first. */
const GROWN_UP = 20;

interface PartProps {
  readonly studio: Studio;
  readonly inForce: ProgrammeInForce;
}

function Course({ studio, inForce }: PartProps) {
  /** What the user has pulled it to and the server has not taken over yet. */
  const [draft, setDraft] = useState<Programme | null>(null);
  /** The point that was touched last. */
  const [chosen, choose] = useState<number | null>(null);
  // What the server says counts from then on.
  useEffect(() => setDraft(null), [inForce]);
  const programme = draft ?? inForce.programme;
  const parameter = NUMBERS[shown.value ?? firstChanging(inForce.programme)];
  const points = pointsOf(programme, parameter);
  const age = studio.document.value?.age ?? 0;
  const scale = new CurveScale(parameter, lastAge(programme, age), FRAME);
  const commit = (changed: Programme) => {
    if (!alike(changed, inForce.programme)) {
      studio.programme.set(changed, { keep: true });
    }
  };
  const pull = (point: Point, to: { readonly age: number; readonly value: number }) => {
    choose(point.change);
    setDraft(withPoint(programme, parameter, point.change, to));
  };
  const place = Math.max(
    0,
    points.findIndex(({ change }) => change === chosen),
  );
  const point = points[place]!;
  const gripped = grippable(points, point, scale);
  return (
    <>
      <select
        aria-label={say("architecture.programme.parameter")}
        value={parameter.name}
        onChange={(event) => {
          shown.value = event.currentTarget.value as NumberParameter["name"];
        }}
      >
        {Object.values(NUMBERS).map((one) => (
          <option value={one.name} key={one.name}>
            {nameOf(one)}
          </option>
        ))}
      </select>
      <Diagram
        width={WIDTH}
        height={HEIGHT}
        drawing={
          <>
            <path class="guide" d={`M${FRAME.left} ${FRAME.top + FRAME.height}h${FRAME.width}`} />
            {programme.stages
              .filter(({ kind }) => kind !== "change")
              .map((stage, index) => (
                <path class="programme-deed" key={index} d={`M${scale.x(stage.age)} ${FRAME.top + FRAME.height}v6`} />
              ))}
            <path class="programme-end" d={`M${scale.x(programme.age)} ${FRAME.top}v${FRAME.height}`} />
            <path class="programme-now" d={`M${scale.x(age)} ${FRAME.top - 6}v${FRAME.height + 6}`} />
            <path
              class="programme-line"
              d={scale.path(points)}
              data-overridden={inForce.byHand.includes(parameter.name)}
            />
            {points
              .filter((one) => !gripped.includes(one))
              .map((one) => (
                <circle class="programme-dot" key={one.change} cx={scale.place(one).x} cy={scale.place(one).y} r={5} />
              ))}
            <text x={scale.x(age)} y={HEIGHT - 8} text-anchor={age * 2 > lastAge(programme, age) ? "end" : "start"}>
              {say("architecture.programme.now", { age })}
            </text>
          </>
        }
      >
        {gripped.map((one) => (
          <Grip
            key={one.change ?? "first"}
            label={say("architecture.programme.stage", { name: nameOf(parameter), age: one.age })}
            text={shownValue(parameter, one.value)}
            least={parameter.least}
            most={parameter.most}
            step={parameter.step}
            value={one.value}
            at={scale.place(one)}
            way={one.change === null ? "upright" : "any"}
            onPull={(to) => pull(one, scale.at(to))}
            onValue={(value) => pull(one, { ...one, value })}
            onArrows={(right, up) => pull(one, { age: one.age + right, value: one.value + up * parameter.step })}
            onRelease={() => commit(programme)}
          />
        ))}
      </Diagram>
      <StageSteps points={points} place={place} choose={choose} />
      <div class="programme-stage">
        <span class="programme-number">
          <span>{say("architecture.programme.from")}</span>
          <TypedNumber
            label={say("architecture.programme.age")}
            unit=""
            least={0}
            most={MAX_AGE}
            step={1}
            value={point.age}
            disabled={point.change === null}
            onCommit={(to) => commit(withPoint(programme, parameter, point.change, { ...point, age: to }))}
          />
        </span>
        <span class="programme-number">
          <span>{nameOf(parameter)}</span>
          <TypedNumber
            label={nameOf(parameter)}
            unit=""
            least={parameter.least}
            most={parameter.most}
            step={parameter.step}
            value={point.value}
            onCommit={(to) => commit(withPoint(programme, parameter, point.change, { ...point, value: to }))}
          />
        </span>
        {point.change !== null && (
          <button type="button" onClick={() => commit(withoutChange(programme, point.change ?? 0))}>
            {say("architecture.programme.remove")}
          </button>
        )}
      </div>
      <Deeds studio={studio} programme={programme} age={age} commit={commit} />
    </>
  );
}

interface StageStepsProps {
  readonly points: readonly Point[];
  /** Which of the points is chosen. */
  readonly place: number;
  readonly choose: (change: number | null) => void;
}

/** Goes from stage to stage, those included that lie too near to another one for a grip of their own. */
function StageSteps({ points, place, choose }: StageStepsProps) {
  const step = (by: number, text: string, label: string) => {
    const to = points[place + by];
    return (
      <button type="button" aria-label={label} disabled={to === undefined} onClick={() => to && choose(to.change)}>
        {text}
      </button>
    );
  };
  return (
    <div class="programme-steps">
      {step(-1, "‹", say("architecture.programme.previous"))}
      <span role="status">{say("architecture.programme.place", { place: place + 1, count: points.length })}</span>
      {step(1, "›", say("architecture.programme.next"))}
    </div>
  );
}

interface DeedsProps {
  readonly studio: Studio;
  readonly programme: Programme;
  readonly age: number;
  readonly commit: (programme: Programme) => void;
}

/** What is done with a programme as a whole. */
function Deeds({ studio, programme, age, commit }: DeedsProps) {
  const species = useSpecies(studio)?.find(({ slug }) => slug === programme.species);
  const isFull = programme.stages.length >= MAX_STAGES;
  const has = changesOf(programme).some((change) => change.age === age);
  return (
    <div class="programme-deeds">
      <button type="button" disabled={isFull || has} onClick={() => commit(withChangeAt(programme, age))}>
        {say("architecture.programme.add", { age })}
      </button>
      {species && !alike(species.programme, programme) && (
        <button type="button" onClick={() => commit(species.programme)}>
          {say("architecture.programme.reset", { name: speciesName(species) })}
        </button>
      )}
      <button type="button" onClick={() => studio.programme.set(null)}>
        {say("architecture.programme.drop")}
      </button>
    </div>
  );
}

/** The parameters that do not follow the programme, to be given back. */
function ByHand({ studio, inForce: { byHand } }: PartProps) {
  if (byHand.length === 0) {
    return <p class="quiet advice">{say("architecture.programme.followed")}</p>;
  }
  return (
    <>
      <p class="advice" role="status">
        {say("architecture.programme.by-hand")}
      </p>
      <ul class="programme-by-hand">
        {byHand.map(parameterOf).map((parameter: GrowthParameter) => (
          <li key={parameter.name}>
            <span>{nameOf(parameter)}</span>
            <button
              type="button"
              aria-label={say("architecture.programme.follow-one", { name: nameOf(parameter) })}
              onClick={() => studio.programme.follow(parameter.name)}
            >
              {say("architecture.programme.follow")}
            </button>
          </li>
        ))}
      </ul>
      {byHand.length > 1 && (
        <button type="button" onClick={() => studio.programme.follow()}>
          {say("architecture.programme.follow-all")}
        </button>
      )}
    </>
  );
}

function lastAge(programme: Programme, age: number): number {
  return Math.max(programme.age, age, ...programme.stages.map((stage) => stage.age)) + 1;
}

/** The number that a programme changes first; apical control where it changes none. */
function firstChanging(programme: Programme): NumberParameter["name"] {
  const names = changesOf(programme).flatMap(({ parameters }) => Object.keys(parameters));
  const first = names.find((name) => Object.hasOwn(NUMBERS, name));
  return (first as NumberParameter["name"] | undefined) ?? "apical_control";
}
