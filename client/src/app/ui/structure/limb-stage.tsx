import { useEffect } from "preact/hooks";
import { LIMB_GROUPS, type LimbShaping } from "../../document/design/limb-shaping";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { Handles, HiddenHandles } from "./handles";

interface LimbStageProps {
  readonly studio: Studio;
  readonly limbs: LimbShaping;
}

/** What lies over the picture while limbs of a tree that grew are shaped: the handles of the chosen one, and a bar. */
export function LimbStage({ studio, limbs }: LimbStageProps) {
  const isOn = limbs.isOn.value && !studio.layout.bare.value;
  useEffect(() => {
    studio.stage.view?.backstage.stir();
  }, [studio, isOn]);
  return isOn ? (
    <>
      {limbs.chosen.value && <Handles studio={studio} shaping={limbs} />}
      <Bar studio={studio} limbs={limbs} />
    </>
  ) : null;
}

/** What to do next, which handles are shown, and how the limb fills its outline. */
function Bar({ studio, limbs }: LimbStageProps) {
  const limb = limbs.limb.value;
  const hint = limbs.isFilling.value ? "limbs.filling" : limb ? "limbs.drag" : "limbs.tap";
  return (
    <section class="panel structure-bar" aria-label={say("limbs.shape")}>
      <p class="structure-bar-hint" role="status">
        {say(hint)}
      </p>
      {limb && (
        <>
          <div class="structure-bar-way">
            <button
              type="button"
              class="tool"
              disabled={limb.told.bearer === undefined}
              aria-label={say("structure.up")}
              title={say("structure.up")}
              onClick={() => limbs.up()}
            >
              ↑
            </button>
            <span class="structure-bar-name">{say(limb.told.bearer === undefined ? "limbs.trunk" : "limbs.limb")}</span>
          </div>
          <button
            type="button"
            class="structure-bar-scope"
            title={say("limbs.anew.help")}
            aria-pressed={limbs.anew.value}
            onClick={() => {
              limbs.anew.value = !limbs.anew.peek();
            }}
          >
            {say("limbs.anew")}
          </button>
          <fieldset class="structure-bar-groups">
            <legend>{say("structure.handles")}</legend>
            {LIMB_GROUPS.map((group) => (
              <button
                type="button"
                key={group}
                aria-pressed={limbs.group.value === group}
                onClick={() => {
                  limbs.group.value = group;
                }}
              >
                {say(`structure.handles.${group}`)}
              </button>
            ))}
          </fieldset>
          {!limbs.isFilling.value && <HiddenHandles studio={studio} shaping={limbs} />}
        </>
      )}
      <button
        type="button"
        class="structure-bar-done"
        onClick={() => {
          limbs.wanted.value = false;
        }}
      >
        {say("structure.done")}
      </button>
    </section>
  );
}
