import { useEffect, useState } from "preact/hooks";
import type { DesignEditing } from "../../../document/design/design-editing";
import { type DesignModel, keyNamed, orderOf, ROOT, wayTo } from "../../../document/design/design-model";
import type { Shaping } from "../../../document/design/shaping";
import { say } from "../../../words/say";

interface BranchListProps {
  readonly editing: DesignEditing;
  readonly model: DesignModel;
}

/** So many of the branches of one are shown at first, and so many more each time that somebody asks. */
const ROWS = 24;
/** No branch has a higher order. */
const MOST_ORDERS = 4;

/** What a branch is called. */
export function titleOf(model: DesignModel, path: string): string {
  const name = model.nameOf(path);
  if (name) {
    return name;
  }
  if (path === ROOT) {
    return say("structure.plant");
  }
  const number = Number(path.slice(path.lastIndexOf("/") + 1)) + 1;
  return say(orderOf(path) === 1 ? "structure.limb" : "structure.branch", { number });
}

/** What all branches of the order of one are called. */
export function allLike(path: string): string {
  const order = orderOf(path);
  return order === 1 ? say("structure.scope.limbs") : say("structure.scope.order", { order });
}

/** All branches as folders in one another, and those that sleep. */
export function BranchList({ editing, model, shaping }: BranchListProps & { readonly shaping: Shaping }) {
  useEffect(() => {
    shaping.isListed.value = true;
    return () => {
      shaping.isListed.value = false;
    };
  }, [shaping]);
  return (
    <>
      <ul class="structure-tree" aria-label={say("structure.branches")}>
        <BranchItem editing={editing} model={model} path={ROOT} />
      </ul>
      {model.told.asleep.length > 0 && (
        <fieldset class="structure-asleep">
          <legend>{say("structure.asleep")}</legend>
          <p class="quiet">{say("structure.asleep.help")}</p>
          {model.told.asleep.map((path) => (
            <div class="structure-row" key={path}>
              <span>{titleOf(model, path)}</span>
              <button type="button" onClick={() => editing.wake(path)}>
                {say("structure.wake")}
              </button>
              <button type="button" onClick={() => editing.forget(path)}>
                {say("structure.forget")}
              </button>
            </div>
          ))}
        </fieldset>
      )}
    </>
  );
}

function BranchItem({ editing, model, path }: BranchListProps & { readonly path: string }) {
  const [rows, setRows] = useState(ROWS);
  const isChosen = editing.chosen.value === path;
  const laterals = editing.laterals(path);
  const isUnfolded = editing.unfolded.value.has(path);
  // Of branches far up nothing is told while another part of the tree is looked at; then they are folded.
  const isOpen = isUnfolded && (laterals !== null || isChosen);
  const title = titleOf(model, path);
  const own = model.ownValues(path);
  const toggle = () => {
    if (laterals === null && !isOpen) {
      editing.choose(path);
    }
    editing.fold(path, !isOpen);
  };
  return (
    <li>
      <div class="structure-item">
        {(laterals === null ? mayBear(model, path) : laterals.length > 0) ? (
          <button
            type="button"
            class="structure-fold"
            aria-expanded={isOpen}
            aria-label={say(isOpen ? "structure.fold" : "structure.unfold", { branch: title })}
            onClick={toggle}
          >
            {isOpen ? "▾" : "▸"}
          </button>
        ) : (
          <span class="structure-fold" aria-hidden="true" />
        )}
        <button type="button" class="structure-name" aria-pressed={isChosen} onClick={() => editing.choose(path)}>
          <span>{title}</span>
          {own > 0 && <em title={say("structure.own-values", { values: own })}>{own}</em>}
        </button>
      </div>
      {isOpen && laterals === null && <p class="quiet structure-rest">{say("structure.asking")}</p>}
      {isOpen && laterals !== null && laterals.length > 0 && (
        <ul>
          {shownOf(laterals, rows, editing.chosen.value).map((lateral) => (
            <BranchItem key={lateral} editing={editing} model={model} path={lateral} />
          ))}
          {laterals.length > rows && (
            <li>
              <button type="button" class="structure-rest" onClick={() => setRows(rows + ROWS)}>
                {say("structure.rest", { shown: rows, all: laterals.length })}
              </button>
            </li>
          )}
        </ul>
      )}
    </li>
  );
}

/** The first of them, and the one on the way to the chosen branch wherever it stands. */
function shownOf(laterals: readonly string[], rows: number, chosen: string): readonly string[] {
  const way = wayTo(chosen);
  return laterals.filter((lateral, at) => at < rows || way.includes(lateral));
}

/** Whether a branch of which nothing was told yet may bear others. */
function mayBear(model: DesignModel, path: string): boolean {
  const orders = Number(model.resolve(path, keyNamed("orders")).value);
  return orderOf(path) < Math.min(orders, MOST_ORDERS);
}
