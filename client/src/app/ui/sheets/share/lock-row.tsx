import { useEffect, useState } from "preact/hooks";
import type { TreeLock } from "../../../../wire/generated";
import { findLock, setLock } from "../../../library/links/link-api";
import { explained } from "../../../problems/explained";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";

interface LockRowProps {
  readonly studio: Studio;
  readonly tree: string;
}

/** Locks the tree, so that owners alone change it, and unlocks it. */
export function LockRow({ studio, tree }: LockRowProps) {
  const [lock, setLockState] = useState<TreeLock | null>(null);
  const [busy, setBusy] = useState(false);
  const ask = async (question: () => Promise<TreeLock>) => {
    setBusy(true);
    try {
      setLockState(await question());
    } catch (error) {
      studio.toasts.show(await explained(error));
    }
    setBusy(false);
  };
  useEffect(() => void ask(() => findLock(tree)), [tree]);
  if (lock === null) {
    return null;
  }
  const isLocked = lock.by !== undefined;
  return (
    <div class="actions lock-row" data-locked={isLocked}>
      {isLocked && <p class="quiet">{say("links.locked", { name: lock.by ?? "" })}</p>}
      <button type="button" class="small" disabled={busy} onClick={() => void ask(() => setLock(tree, !isLocked))}>
        {say(isLocked ? "links.unlock" : "links.lock")}
      </button>
    </div>
  );
}
