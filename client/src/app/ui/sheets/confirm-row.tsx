import { useState } from "preact/hooks";
import { say } from "../../words/say";

interface ConfirmRowProps {
  /** What comes of it. */
  readonly question: string;
  /** What is done, as the button says it. */
  readonly act: string;
  readonly onAct: () => Promise<void>;
  readonly onKeep: () => void;
}

/** Asks once before something is done that cannot be taken back. */
export function ConfirmRow({ question, act, onAct, onKeep }: ConfirmRowProps) {
  const [acting, setActing] = useState(false);
  const go = async () => {
    setActing(true);
    await onAct();
    setActing(false);
    onKeep();
  };
  return (
    <div class="card-confirm">
      <span role="alert">{question}</span>
      <button type="button" class="small danger" disabled={acting} onClick={() => void go()}>
        {act}
      </button>
      <button type="button" class="small" disabled={acting} onClick={onKeep}>
        {say("sheets.library.keep")}
      </button>
    </div>
  );
}
