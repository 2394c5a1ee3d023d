import type { DesignEditing } from "../../../document/design/design-editing";
import { type DesignModel, orderOf, ROOT } from "../../../document/design/design-model";
import { say } from "../../../words/say";

interface BranchListProps {
  readonly editing: DesignEditing;
  readonly model: DesignModel;
}

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

/** All branches down to those of limbs, as folders in one another, and those that sleep. */
export function BranchList({ editing, model }: BranchListProps) {
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
  const laterals = model.laterals(path);
  const isOpen = editing.unfolded.value.has(path);
  const title = titleOf(model, path);
  const own = model.ownValues(path);
  return (
    <li>
      <div class="structure-item">
        {laterals.length > 0 ? (
          <button
            type="button"
            class="structure-fold"
            aria-expanded={isOpen}
            aria-label={say(isOpen ? "structure.fold" : "structure.unfold", { branch: title })}
            onClick={() => editing.fold(path, !isOpen)}
          >
            {isOpen ? "▾" : "▸"}
          </button>
        ) : (
          <span class="structure-fold" aria-hidden="true" />
        )}
        <button
          type="button"
          class="structure-name"
          aria-pressed={editing.chosen.value === path}
          onClick={() => editing.choose(path)}
        >
          <span>{title}</span>
          {own > 0 && <em title={say("structure.own-values", { values: own })}>{own}</em>}
        </button>
      </div>
      {isOpen && laterals.length > 0 && (
        <ul>
          {laterals.map((lateral) => (
            <BranchItem key={lateral} editing={editing} model={model} path={lateral} />
          ))}
        </ul>
      )}
    </li>
  );
}
