import type { ComponentChildren } from "preact";
import { useRef } from "preact/hooks";
import {
  BOUNDS,
  DEEPEST,
  FARTHEST,
  MAX_OBSTACLES,
  type PlacedObstacle,
  type Pose,
  type Shape,
} from "../../../wire/generated";
import { type SimpleShape, UndoGroup } from "../../document/obstacles/obstacle-list";
import { rotationOf, turningOf } from "../../document/obstacles/turning";
import type { Studio } from "../../studio";
import { toolFor } from "../../tools/tools";
import { say } from "../../words/say";
import { Field } from "../controls/field";
import { TypedNumber } from "../controls/typed-number";
import { BoxIcon, DeleteIcon, ModelIcon, NewIcon, PlaneIcon, SphereIcon, WallIcon } from "../icons";

type Kind = "box" | "sphere" | "wall" | "plane";

const KINDS: readonly (readonly [Kind, () => ComponentChildren])[] = [
  ["box", BoxIcon],
  ["sphere", SphereIcon],
  ["wall", WallIcon],
  ["plane", PlaneIcon],
];

/** What stands in the scene beside the trees: added, moved, taken away; and where new seeds come from. */
export function ScenePanel({ studio }: { studio: Studio }) {
  const { list, chosen, transfer } = studio.obstacles;
  const obstacles = studio.obstacles.drawn.value;
  const full = list.value.length >= MAX_OBSTACLES;
  return (
    <>
      <div class="kinds">
        {KINDS.map(([kind, Icon]) => (
          <button type="button" key={kind} disabled={full} onClick={() => add(studio, kind)}>
            <Icon />
            {say(`scene.${kind}`)}
          </button>
        ))}
        <ModelButton studio={studio} disabled={full || transfer.progress.value !== null} />
        <button type="button" onClick={() => studio.tools.choose(toolFor("plant"))}>
          <NewIcon />
          {say("scene.seed")}
        </button>
      </div>
      {obstacles.length === 0 ? (
        <p class="quiet advice">{say("scene.advice")}</p>
      ) : (
        <ul class="obstacles">
          {obstacles.map((obstacle) => (
            <li key={obstacle.id} data-chosen={obstacle.id === chosen.value}>
              <div class="obstacle-head">
                <button
                  type="button"
                  class="obstacle-name"
                  aria-expanded={obstacle.id === chosen.value}
                  onClick={() => {
                    chosen.value = obstacle.id === chosen.value ? null : obstacle.id;
                  }}
                >
                  <ShapeIcon obstacle={obstacle} />
                  {nameOf(obstacle)}
                </button>
                <button
                  type="button"
                  class="tool"
                  aria-label={say("scene.remove.which", { name: nameOf(obstacle) })}
                  title={say("scene.remove")}
                  onClick={() => studio.obstacles.remove(obstacle.id)}
                >
                  <DeleteIcon />
                </button>
              </div>
              {obstacle.id === chosen.value && <Measures studio={studio} obstacle={obstacle} />}
            </li>
          ))}
        </ul>
      )}
    </>
  );
}

/** Lets a model be chosen: one .glb or .obj, or a .gltf with its buffers. */
function ModelButton({ studio, disabled }: { studio: Studio; disabled: boolean }) {
  const input = useRef<HTMLInputElement>(null);
  const take = async (files: readonly File[]) => {
    if (files.length > 0) {
      await studio.obstacles.import(files);
    }
    if (input.current) {
      // The same file can then be chosen again.
      input.current.value = "";
    }
  };
  return (
    <>
      <button type="button" disabled={disabled} onClick={() => input.current?.click()} title={say("scene.model.title")}>
        <ModelIcon />
        {say("scene.model")}
      </button>
      <input
        ref={input}
        hidden
        type="file"
        multiple
        accept=".glb,.gltf,.bin,.obj,.zip,model/gltf-binary,model/gltf+json,model/obj"
        onChange={(event) => void take([...(event.currentTarget.files ?? [])])}
      />
    </>
  );
}

/** Where the chosen obstacle stands, how it is turned and how large it is, in numbers. */
function Measures({ studio, obstacle }: { studio: Studio; obstacle: PlacedObstacle }) {
  const { id, pose, shape } = obstacle;
  const [x, y, z] = pose.position;
  const group = useRef(new UndoGroup());
  const another = () => {
    group.current = new UndoGroup();
  };
  const turning = turningOf(pose.rotation);
  const move = (to: Partial<Pose>) => studio.obstacles.move(id, { ...pose, ...to }, group.current);
  const reshape = (to: SimpleShape) => studio.obstacles.reshape(id, to, group.current);
  const turn = (to: Partial<typeof turning>) => move({ rotation: rotationOf({ ...turning, ...to }) });
  const first = studio.obstacles.first(id) ?? obstacle;
  const [firstX, firstY, firstZ] = first.pose.position;
  const firstTurning = turningOf(first.pose.rotation);
  return (
    <div
      class="measures"
      onPointerDownCapture={another}
      // A key that is held down is one undo.
      onKeyDownCapture={(event) => event.repeat || another()}
      // What was typed is sent as its field is left, and does not belong to what was begun meanwhile.
      onFocusOut={another}
    >
      <Measure
        name="scene.across"
        value={x}
        first={firstX}
        least={-FARTHEST}
        most={FARTHEST}
        onCommit={(value) => move({ position: [value, y, z] })}
      />
      <Measure
        name="scene.up"
        value={y}
        first={firstY}
        least={DEEPEST}
        most={FARTHEST}
        onCommit={(value) => move({ position: [x, value, z] })}
      />
      <Measure
        name="scene.deep"
        value={z}
        first={firstZ}
        least={-FARTHEST}
        most={FARTHEST}
        onCommit={(value) => move({ position: [x, y, value] })}
      />
      {shape.kind !== "sphere" && (
        <>
          <Measure
            name="scene.turn"
            unit="°"
            value={turning.turn}
            first={firstTurning.turn}
            least={-360}
            most={360}
            onCommit={(value) => turn({ turn: value })}
          />
          <Measure
            name="scene.tilt"
            unit="°"
            value={turning.tilt}
            first={firstTurning.tilt}
            least={-90}
            most={90}
            onCommit={(value) => turn({ tilt: value })}
          />
        </>
      )}
      {shape.kind === "sphere" && (
        <Measure
          name="scene.radius"
          value={shape.radius}
          first={first.shape.kind === "sphere" ? first.shape.radius : shape.radius}
          {...BOUNDS.SphereRadius}
          onCommit={(radius) => reshape({ kind: "sphere", radius })}
        />
      )}
      {shape.kind === "box" &&
        (["scene.width", "scene.height", "scene.depth"] as const).map((name, axis) => (
          <Measure
            key={name}
            name={name}
            value={shape.size[axis] ?? 1}
            first={(first.shape.kind === "box" ? first.shape : shape).size[axis] ?? 1}
            {...BOUNDS.BoxSide}
            onCommit={(value) => {
              const size = shape.size.map((side, i) => (i === axis ? value : side)) as typeof shape.size;
              reshape({ kind: "box", size });
            }}
          />
        ))}
    </div>
  );
}

interface MeasureProps {
  readonly name: `scene.${"across" | "up" | "deep" | "turn" | "tilt" | "radius" | "width" | "height" | "depth"}`;
  readonly value: number;
  /** What it was when this page first saw the obstacle. */
  readonly first: number;
  readonly least: number;
  readonly most: number;
  readonly unit?: string;
  readonly onCommit: (value: number) => void;
}

/** One number of an obstacle; its way is too long for a slider. */
function Measure({ name, value, first, least, most, unit = "", onCommit }: MeasureProps) {
  const label = say(name);
  return (
    <Field
      label={label}
      help={say(`${name}.help`)}
      onReset={Math.abs(value - first) < MEASURE_STEP / 2 ? undefined : () => onCommit(first)}
      end={<TypedNumber {...{ label, unit, least, most, value, onCommit }} step={MEASURE_STEP} />}
    />
  );
}

/** Tenths of an internode or a degree are fine enough. */
const MEASURE_STEP = 0.1;

function ShapeIcon({ obstacle: { shape } }: { obstacle: PlacedObstacle }) {
  switch (shape.kind) {
    case "box":
      return isWall(shape) ? <WallIcon /> : <BoxIcon />;
    case "sphere":
      return <SphereIcon />;
    case "plane":
      return <PlaneIcon />;
    case "mesh":
      return <ModelIcon />;
  }
}

function nameOf({ shape, id }: PlacedObstacle): string {
  const kind = shape.kind === "mesh" ? "model" : isWall(shape) ? "wall" : shape.kind;
  return `${say(`scene.${kind}`)} ${id}`;
}

/** A box that is much taller and wider than it is thick. */
function isWall(shape: PlacedObstacle["shape"]): boolean {
  if (shape.kind !== "box") {
    return false;
  }
  const [least = 0, middle = 0] = [...shape.size].sort((a, b) => a - b);
  return least * 4 <= middle;
}

/** Puts a new obstacle on the ground, to the right of the tree in the middle as it is seen now. */
function add(studio: Studio, kind: Kind): void {
  const { base, right } = studio.stage.middle();
  const beside = (away: number, up: number): Pose["position"] => [
    base[0] + right[0] * away,
    up,
    base[2] + right[2] * away,
  ];
  const facing = rotationOf({ turn: (Math.atan2(-right[2], right[0]) * 180) / Math.PI, tilt: 0 });
  const placed: Record<Kind, readonly [Shape, Pose]> = {
    box: [
      { kind: "box", size: [5, 5, 5] },
      { position: beside(8, 2.5), rotation: facing },
    ],
    sphere: [{ kind: "sphere", radius: 3.5 }, { position: beside(8, 3.5) }],
    wall: [
      { kind: "box", size: [1, 16, 24] },
      { position: beside(6, 8), rotation: facing },
    ],
    plane: [{ kind: "plane" }, { position: [0, 0, 0] }],
  };
  studio.obstacles.place(...placed[kind]);
}
