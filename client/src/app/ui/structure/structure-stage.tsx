import { useEffect } from "preact/hooks";
import { HANDLE_GROUPS } from "../../document/design/branch-handles";
import { ROOT } from "../../document/design/design-model";
import { designOf } from "../../document/design/design-of";
import type { Shaping } from "../../document/design/shaping";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { allLike, titleOf } from "../panels/structure/branch-list";
import { Handles, HiddenHandles } from "./handles";

interface StageProps {
  readonly studio: Studio;
  readonly shaping: Shaping;
}

/** What lies over the picture while a design is shaped by hand: the axis of the chosen branch, its handles, and a bar. */
export function StructureStage({ studio, shaping }: StageProps) {
  const isOn = shaping.isOn.value && !studio.layout.bare.value;
  useEffect(() => {
    studio.stage.view?.backstage.stir();
  }, [studio, isOn]);
  return isOn && shaping.chosen.value ? (
    <>
      <Handles studio={studio} shaping={shaping} />
      <Bar studio={studio} shaping={shaping} />
    </>
  ) : null;
}

/** Which branch is chosen, the ways to others, and which handles it shows. */
function Bar({ studio, shaping }: StageProps) {
  const editing = designOf(studio);
  const [model, path] = [editing.model.value, editing.chosen.value];
  if (!model) {
    return null;
  }
  const placed = shaping.shapes.value.get(path)?.placed;
  const isAxis = shaping.draws.value === "axis";
  return (
    <section class="panel structure-bar" aria-label={say("structure.shaping")}>
      {shaping.sketching.value && (
        <p class="structure-bar-hint">{say(isAxis ? "structure.sketch.axis" : "structure.sketch.help")}</p>
      )}
      <div class="structure-bar-way">
        <button
          type="button"
          class="tool"
          disabled={path === ROOT}
          aria-label={say("structure.up")}
          title={say("structure.up")}
          onClick={() => shaping.up()}
        >
          ↑
        </button>
        <span class="structure-bar-name" role="status">
          {editing.scope.value === "order" ? allLike(path) : titleOf(model, path)}
        </span>
        <button
          type="button"
          class="tool"
          disabled={!placed?.bears}
          aria-label={say("structure.down")}
          title={say("structure.down")}
          onClick={() => shaping.down()}
        >
          ↓
        </button>
      </div>
      {path !== ROOT && (
        <button
          type="button"
          class="structure-bar-scope"
          title={say("structure.scope.help")}
          aria-pressed={editing.scope.value === "order"}
          onClick={() => editing.speakOf(editing.scope.peek() === "order" ? "branch" : "order")}
        >
          {allLike(path)}
        </button>
      )}
      <fieldset class="structure-bar-groups">
        <legend>{say("structure.handles")}</legend>
        {HANDLE_GROUPS.map((group) => (
          <button
            type="button"
            key={group}
            aria-pressed={!shaping.sketching.value && shaping.group.value === group}
            onClick={() => {
              shaping.sketching.value = false;
              shaping.group.value = group;
            }}
          >
            {say(`structure.handles.${group}`)}
          </button>
        ))}
        <button
          type="button"
          title={say(isAxis ? "structure.sketch.axis" : "structure.sketch.help")}
          aria-pressed={shaping.sketching.value}
          onClick={() => {
            shaping.sketching.value = !shaping.sketching.peek();
          }}
        >
          {say(isAxis ? "structure.sketch.axis.short" : "structure.sketch")}
        </button>
      </fieldset>
      <HiddenHandles studio={studio} shaping={shaping} />
      <button
        type="button"
        class="structure-bar-done"
        onClick={() => {
          shaping.wanted.value = false;
        }}
      >
        {say("structure.done")}
      </button>
    </section>
  );
}
