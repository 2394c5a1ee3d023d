import type { Transfer } from "../../requests/transfer";
import { language, say } from "../../words/say";
import { StopIcon } from "../icons";
import { useLasting } from "./use-lasting";

interface TransferChipProps {
  readonly transfer: Transfer;
  readonly name: "export" | "import" | "picture" | "tree";
}

/** A file on its way, how far it has come, and a way to give it up. */
export function TransferChip({ transfer, name }: TransferChipProps) {
  const progress = transfer.progress.value;
  const shown = useLasting(progress !== null);
  if (!shown || progress === null) {
    return null;
  }
  const { bytes, total, isMaking = false, ahead = 0 } = progress;
  // How much it will be is a guess while it is made.
  const percent = total ? Math.min(isMaking ? 99 : 100, Math.round((100 * bytes) / total)) : null;
  const figures = new Intl.NumberFormat(language.value, { minimumFractionDigits: 1, maximumFractionDigits: 1 });
  const megabytes = (count: number) => figures.format(count / 1e6);
  const text =
    ahead > 0
      ? say("transfers.export.waits", { count: ahead })
      : bytes === 0
        ? say(`transfers.${name}`)
        : isMaking && name === "export"
          ? say("transfers.export.making", { percent: percent ?? 0 })
          : percent === 100
            ? say(`transfers.${name}.read`)
            : total === null && name !== "picture"
              ? say(`transfers.${name}.moving`, { megabytes: megabytes(bytes) })
              : say(`transfers.${name}.part`, {
                  done: megabytes(bytes),
                  megabytes: megabytes(total ?? 0),
                  percent: percent ?? 0,
                });
  return (
    <p class="chip">
      {/* Where the duration is not known, the bar only moves. */}
      {percent === null ? (
        <progress aria-label={text} key="some" />
      ) : (
        <progress {...{ max: 100, value: percent }} aria-label={text} key="part" />
      )}
      {text}
      <button type="button" class="chip-stop" onClick={() => transfer.cancel()}>
        <StopIcon />
        {say("transfers.cancel")}
      </button>
    </p>
  );
}
