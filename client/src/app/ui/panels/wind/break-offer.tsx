import { useEffect, useState } from "preact/hooks";
import { blows } from "../../../../scene/motion/air-settings";
import { motionRows } from "../../../../scene/motion/motion-rows";
import { breaking, stressesOf } from "../../../../scene/motion/strain";
import { DEFAULT_PARAMETERS } from "../../../../wire/generated";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { Switch } from "../../controls/switch";

/** Milliseconds without a change after which it is looked at anew. */
const SETTLED = 300;

interface Found {
  readonly rows: readonly number[];
  readonly branches: number;
  /** At how many rows nothing can be cut, because they are the trunk's. */
  readonly kept: number;
}

/** Offers to cut off what cannot stand the weather that is set. */
export function BreakOffer({ studio }: { studio: Studio }) {
  const [asked, setAsked] = useState(false);
  const [found, setFound] = useState<Found | null>(null);
  const air = studio.appearance.value.wind;
  const { internode_length: internodeLength, leaf_size: leafSize } = studio.parameters.value ?? DEFAULT_PARAMETERS;
  const revision = studio.revision.value;
  const weather = JSON.stringify(air);
  useEffect(() => {
    if (!asked) return;
    const timer = setTimeout(() => {
      const rows = motionRows(studio.table);
      const broken = breaking(rows, stressesOf(rows, { internodeLength, leafSize }, air));
      const marked = studio.tools.toolFor("cut")?.mark?.(broken) ?? { branches: 0, kept: 0 };
      setFound({ rows: broken, ...marked });
    }, SETTLED);
    return () => clearTimeout(timer);
  }, [asked, revision, weather, internodeLength, leafSize, studio]);
  useEffect(() => {
    const unmark = () => void studio.tools.toolFor("cut")?.mark?.([]);
    return asked ? unmark : undefined;
  }, [asked, studio]);
  return (
    <>
      <Switch
        label={say("wind.break")}
        help={say("wind.break.help")}
        value={asked}
        standard={false}
        onCommit={(on) => {
          setFound(null);
          setAsked(on);
        }}
      />
      {asked && (
        <p class="quiet" role="status">
          {found ? say(wordOf(found, blows(air)), { count: found.branches }) : say("wind.break.looking")}
        </p>
      )}
      {asked && found && found.branches > 0 && (
        <button
          type="button"
          class="primary danger"
          onClick={() => {
            studio.tools.toolFor("cut")?.cut?.(found.rows);
            setFound(null);
          }}
        >
          {say(found.branches === 1 ? "tools.cut.one" : "tools.cut.many", { count: found.branches })}
        </button>
      )}
    </>
  );
}

function wordOf({ branches, kept }: Found, blows: boolean) {
  if (!blows) return "wind.break.calm";
  if (kept > 0) return "wind.break.trunk";
  return branches === 0 ? "wind.break.none" : branches === 1 ? "wind.break.one" : "wind.break.many";
}
