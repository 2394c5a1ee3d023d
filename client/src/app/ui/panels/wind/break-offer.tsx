import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { blows } from "../../../../scene/motion/air-settings";
import { motionRows } from "../../../../scene/motion/motion-rows";
import { StrainAsker } from "../../../../scene/motion/strain-asker";
import { DEFAULT_PARAMETERS, MAX_PRUNED_ROWS } from "../../../../wire/generated";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { Switch } from "../../controls/switch";

/** Milliseconds without a change after which it is looked at anew. */
const SETTLED = 300;

interface Found {
  /** Where the branches begin that would break. */
  readonly cuts: readonly number[];
  /** At how many rows nothing can be cut, because they are the trunk's. */
  readonly kept: number;
  /** The rows it was found in. */
  readonly revision: number;
}

/** Offers to cut off what cannot stand the weather that is set. */
export function BreakOffer({ studio }: { studio: Studio }) {
  const [asked, setAsked] = useState(false);
  const [found, setFound] = useState<Found | null>(null);
  /** Counts the cuts: after each it is looked at anew, even where the server refused it. */
  const [round, setRound] = useState(0);
  const air = studio.appearance.value.wind;
  const { internode_length: internodeLength, leaf_size: leafSize } = studio.parameters.value ?? DEFAULT_PARAMETERS;
  const revision = studio.revision.value;
  const obstacles = studio.obstacles.drawn.value;
  const weather = JSON.stringify(air);
  /** The rows that it was asked of last. */
  const of = useRef(revision);
  const asker = useMemo(
    () =>
      new StrainAsker((rows) => {
        // Rows that have changed since are asked about next.
        if (studio.revision.peek() !== of.current) return;
        const marked = studio.tools.toolFor("cut")?.mark?.(Array.from(rows)) ?? { cuts: [], kept: 0 };
        setFound({ ...marked, revision: of.current });
      }),
    [studio],
  );
  useEffect(() => {
    if (!asked) return;
    const timer = setTimeout(() => {
      of.current = revision;
      asker.ask({ rows: motionRows(studio.table), scale: { internodeLength, leafSize }, air, obstacles });
    }, SETTLED);
    return () => clearTimeout(timer);
  }, [asked, round, revision, weather, obstacles, internodeLength, leafSize, studio, asker]);
  useEffect(() => (asked ? () => asker.forget() : undefined), [asked, asker]);
  useEffect(() => {
    const unmark = () => void studio.tools.toolFor("cut")?.mark?.([]);
    return asked ? unmark : undefined;
  }, [asked, studio]);
  // A cut takes so many branches at most; the rest is offered next.
  const count = Math.min(found?.cuts.length ?? 0, MAX_PRUNED_ROWS);
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
          {found ? say(wordOf(found, blows(air)), { count: found.cuts.length }) : say("wind.break.looking")}
        </p>
      )}
      {asked && found && found.cuts.length > 0 && found.kept > 0 && <p class="quiet">{say("wind.break.trunk")}</p>}
      {asked && found && count > 0 && (
        <button
          type="button"
          class="primary danger"
          disabled={found.revision !== revision}
          onClick={() => {
            studio.tools.toolFor("cut")?.cut?.(found.cuts.slice(0, count));
            setFound(null);
            setRound(round + 1);
          }}
        >
          {say(count === 1 ? "tools.cut.one" : "tools.cut.many", { count })}
        </button>
      )}
    </>
  );
}

function wordOf({ cuts, kept }: Found, blows: boolean) {
  if (!blows) return "wind.break.calm";
  if (cuts.length > 0) return cuts.length === 1 ? "wind.break.one" : "wind.break.many";
  return kept > 0 ? "wind.break.trunk" : "wind.break.none";
}
