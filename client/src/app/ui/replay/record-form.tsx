import { useEffect, useState } from "preact/hooks";
import { keepFile } from "../../library/exports";
import { fileName } from "../../library/file-name";
import { explained } from "../../problems/explained";
import { arrive } from "../../replay/arrival";
import { frameArchive } from "../../replay/frame-archive";
import type { ReplayPlayer } from "../../replay/player";
import { RATE, record } from "../../replay/recording";
import { type VideoKind, video, videoKind } from "../../replay/video";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { Segments } from "../controls/segments";
import { usualName } from "../sheets/name-field";

/** How long the design plays in a recording, to choose from, in seconds. */
const LENGTHS = ["5", "10", "20", "40"];
/** Pixels along the longer side of a picture, to choose from. */
const SIDES = ["1280", "1920", "3840"];

interface RecordFormProps {
  readonly studio: Studio;
  readonly player: ReplayPlayer;
  readonly onDone: () => void;
}

/** Records the replay as it is seen: as a video where the browser can, or as pictures. */
export function RecordForm({ studio, player, onDone }: RecordFormProps) {
  const [form, setForm] = useState<string>("video");
  const [length, setLength] = useState("10");
  const [side, setSide] = useState("1280");
  const [kind, setKind] = useState<VideoKind | null | undefined>(undefined);
  const size = sizeOf(studio, Number(side));
  useEffect(() => {
    void videoKind(size).then(setKind, () => setKind(null));
  }, [size.width, size.height]);
  const isVideo = form === "video" && kind !== null;
  const start = (event: Event) => {
    event.preventDefault();
    onDone();
    void recorded(studio, player, { size, seconds: Number(length), kind: isVideo ? (kind ?? null) : null });
  };
  return (
    <form class="panel record-form stack" onSubmit={start} aria-label={say("replay.record")}>
      <Segments
        legend={say("replay.form")}
        name="replay-form"
        values={kind === null ? ["frames"] : ["video", "frames"]}
        chosen={kind === null ? "frames" : form}
        text={(form) => (form === "video" ? say("replay.video") : say("replay.frames"))}
        onChoose={setForm}
      />
      {kind === null && <p class="quiet">{say("replay.video.none")}</p>}
      <Segments
        legend={say("replay.length")}
        name="replay-length"
        values={LENGTHS}
        chosen={length}
        text={(seconds) => say("replay.seconds", { seconds })}
        onChoose={setLength}
      />
      <Segments
        legend={say("sheets.download.size")}
        name="replay-size"
        values={SIDES}
        chosen={side}
        text={(side) => {
          const { width, height } = sizeOf(studio, Number(side));
          return `${width} × ${height}`;
        }}
        onChoose={setSide}
      />
      <p class="quiet">{say("replay.record.advice", { rate: RATE })}</p>
      <button type="submit" class="primary" disabled={form === "video" && kind === undefined}>
        {say("replay.record.start")}
      </button>
    </form>
  );
}

/** A size in the proportions of what is seen; encoders want even numbers. */
function sizeOf(studio: Studio, side: number): { width: number; height: number } {
  const { width, height } = studio.stage.pixels() ?? { width: 16, height: 9 };
  const even = (length: number) => 2 * Math.max(1, Math.round((length * side) / Math.max(width, height) / 2));
  return { width: even(width), height: even(height) };
}

interface Wish {
  readonly size: { readonly width: number; readonly height: number };
  readonly seconds: number;
  /** Null for pictures. */
  readonly kind: VideoKind | null;
}

async function recorded(studio: Studio, player: ReplayPlayer, { size, seconds, kind }: Wish): Promise<void> {
  const { exports, stage, time } = studio;
  const before = time.step;
  const end = player.end;
  try {
    const file = await exports.picture.run(async (stop, tell) =>
      record({
        seconds,
        stepAt: (share) => time.scale.peek().stepAt(share * end),
        show: (step) => arrive(studio, step, stop),
        photograph: (stop) => stage.picture(size, stop, () => {}),
        sink: kind ? await video(kind, size, RATE) : frameArchive(),
        stop,
        tell: (made, all) => tell({ bytes: Math.round((100 * made) / all), total: 100 }),
      }),
    );
    if (file !== null) {
      keepFile(file, fileName(studio.trees.name.peek() ?? usualName(studio), kind?.ending ?? "frames.zip"));
      studio.toasts.show(say("replay.recorded"));
    }
  } catch (error) {
    studio.toasts.show(await explained(error));
  }
  if (studio.link.replaying.peek()) {
    time.to(before);
  }
}
