import type { ComponentChildren } from "preact";
import { useRef } from "preact/hooks";
import { MAX_OBSTACLES, type PlacedObstacle, type Pose, type Shape } from "../../wire/generated";
import type { Studio } from "../studio";
import { rotationOf, turningOf } from "../turning";
import { say } from "../words";
import { BoxIcon, DeleteIcon, ModelIcon, NewIcon, PlaneIcon, SphereIcon, WallIcon } from "./icons";
import { Panel } from "./panel";

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
    <Panel studio={studio} title={say("panels.scene")}>
      <div class="kinds">
        {KINDS.map(([kind, Icon]) => (
          <button type="button" key={kind} disabled={full} onClick={() => add(studio, kind)}>
            <Icon />
            {say(`scene.${kind}`)}
          </button>
        ))}
        <ModelButton studio={studio} disabled={full || transfer.progress.value !== null} />
        <button type="button" onClick={() => studio.tools.choose("seed")}>
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
    </Panel>
  );
}

/** Lets a model be chosen: one .glb, or a .gltf with its buffers. */
function ModelButton({ studio, disabled }: { studio: Studio; disabled: boolean }) {
  const input = useRef<HTMLInputElement>(null);
  const take = async (files: FileList | null) => {
    const named = [...(files ?? [])].map(async (file) => ({
      name: file.name,
      bytes: new Uint8Array(await file.arrayBuffer()),
    }));
    if (named.length > 0) {
      await studio.obstacles.import(await Promise.all(named));
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
        accept=".glb,.gltf,.bin,model/gltf-binary,model/gltf+json"
        onChange={(event) => void take(event.currentTarget.files)}
      />
    </>
  );
}

/** Where the obstacle at hand stands, how it is turned and how large it is, in numbers. */
function Measures({ studio, obstacle }: { studio: Studio; obstacle: PlacedObstacle }) {
  const { id, pose, shape } = obstacle;
  const [x, y, z] = pose.position;
  const turning = turningOf(pose.rotation);
  const move = (to: Partial<Pose>) => studio.obstacles.move(id, { ...pose, ...to });
  const turn = (to: Partial<typeof turning>) => move({ rotation: rotationOf({ ...turning, ...to }) });
  return (
    <div class="measures">
      <Measure
        label={say("scene.across")}
        value={x}
        low={-1000}
        high={1000}
        set={(value) => move({ position: [value, y, z] })}
      />
      <Measure
        label={say("scene.up")}
        value={y}
        low={-10}
        high={1000}
        set={(value) => move({ position: [x, value, z] })}
      />
      <Measure
        label={say("scene.deep")}
        value={z}
        low={-1000}
        high={1000}
        set={(value) => move({ position: [x, y, value] })}
      />
      {shape.kind !== "sphere" && (
        <>
          <Measure
            label={say("scene.turn")}
            unit="°"
            value={turning.turn}
            low={-360}
            high={360}
            step={5}
            set={(value) => turn({ turn: value })}
          />
          <Measure
            label={say("scene.tilt")}
            unit="°"
            value={turning.tilt}
            low={-90}
            high={90}
            step={5}
            set={(value) => turn({ tilt: value })}
          />
        </>
      )}
      {shape.kind === "sphere" && (
        <Measure
          label={say("scene.radius")}
          value={shape.radius}
          low={0.1}
          high={500}
          set={(radius) => studio.obstacles.reshape(id, { kind: "sphere", radius })}
        />
      )}
      {shape.kind === "box" &&
        (["scene.width", "scene.height", "scene.depth"] as const).map((label, axis) => (
          <Measure
            key={label}
            label={say(label)}
            value={shape.size[axis] ?? 1}
            low={0.1}
            high={1000}
            set={(value) => {
              const size = shape.size.map((side, i) => (i === axis ? value : side)) as typeof shape.size;
              studio.obstacles.reshape(id, { kind: "box", size });
            }}
          />
        ))}
    </div>
  );
}

interface MeasureProps {
  readonly label: string;
  readonly value: number;
  readonly low: number;
  readonly high: number;
  readonly step?: number;
  readonly unit?: string;
  readonly set: (value: number) => void;
}

function Measure({ label, value, low, high, step = 0.5, unit, set }: MeasureProps) {
  return (
    <label class="measure">
      <span>
        {label}
        {unit && ` ${unit}`}
      </span>
      <input
        type="number"
        inputMode="decimal"
        min={low}
        max={high}
        step={step}
        value={Math.round(value * 100) / 100}
        onChange={(event) => {
          const to = event.currentTarget.valueAsNumber;
          if (Number.isFinite(to)) {
            set(Math.min(high, Math.max(low, to)));
          }
        }}
      />
    </label>
  );
}

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
