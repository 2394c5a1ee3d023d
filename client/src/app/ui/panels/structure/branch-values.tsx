import type { DesignEditing } from "../../../document/design/design-editing";
import {
  bearerOf,
  type DesignKey,
  type DesignModel,
  KEY_GROUPS,
  keysOf,
  levelOf,
  orderOf,
  type Resolved,
  ROOT,
  type Scope,
  type Status,
  wayTo,
} from "../../../document/design/design-model";
import { say } from "../../../words/say";
import { allLike, titleOf } from "./branch-list";
import type { BaseColours } from "./material-editor";
import { ValueEditor } from "./value-editor";

interface ValuesProps {
  readonly editing: DesignEditing;
  readonly model: DesignModel;
  /** The colours of the tree as a whole. */
  readonly colours: BaseColours;
}

/** All parameters of the chosen branch, and what can be done with it as a whole. */
export function BranchValues({ editing, model, colours }: ValuesProps) {
  const path = editing.chosen.value;
  const copied = editing.copied.value;
  return (
    <>
      <nav class="structure-way" aria-label={say("structure.way")}>
        {wayTo(path).map((step) => (
          <button type="button" key={step} aria-current={step === path} onClick={() => editing.choose(step)}>
            {titleOf(model, step)}
          </button>
        ))}
      </nav>
      {path !== ROOT && <ScopeChoice editing={editing} path={path} />}
      <div class="structure-row">
        <button type="button" onClick={() => editing.copy()}>
          {say("structure.copy")}
        </button>
        <button type="button" disabled={copied === null || copied === path} onClick={() => editing.paste()}>
          {say("structure.paste")}
        </button>
        <button
          type="button"
          disabled={path === ROOT || model.ownValues(path) === 0}
          onClick={() => editing.forget(path)}
        >
          {say("structure.forget")}
        </button>
      </div>
      <nav class="structure-groups" aria-label={say("structure.groups")}>
        {KEY_GROUPS.map((group) => (
          <button
            type="button"
            key={group}
            aria-pressed={editing.group.value === group}
            onClick={() => {
              editing.group.value = group;
            }}
          >
            {say(`structure.group.${group}`)}
          </button>
        ))}
      </nav>
      {keysOf(path, editing.group.value).map((key) => (
        <ValueRow key={key.name} editing={editing} model={model} path={path} of={key} colours={colours} />
      ))}
    </>
  );
}

/** Whether values are said of the chosen branch, or of all of its order. */
function ScopeChoice({ editing, path }: { readonly editing: DesignEditing; readonly path: string }) {
  return (
    <fieldset class="structure-ways">
      <legend>{say("structure.scope")}</legend>
      {(["branch", "order"] as const).map((scope) => (
        <button
          type="button"
          key={scope}
          aria-pressed={editing.scope.value === scope}
          onClick={() => editing.speakOf(scope)}
        >
          {scope === "branch" ? say("structure.scope.branch") : allLike(path)}
        </button>
      ))}
    </fieldset>
  );
}

interface ValueRowProps extends ValuesProps {
  readonly path: string;
  readonly of: DesignKey;
}

/** One parameter: its editor, how the branch has it, and where it comes from. */
function ValueRow({ editing, model, path, of, colours }: ValueRowProps) {
  const scope = editing.scope.value;
  const resolved = model.resolve(path, of, scope);
  const exceptions = scope === "order" ? model.exceptions(orderOf(path), of.name) : [];
  const isShown = editing.key.value === of.name;
  return (
    <div class="structure-value" data-status={resolved.status}>
      <ValueEditor editing={editing} of={of} resolved={resolved} colours={colours} />
      <button
        type="button"
        class="structure-status"
        aria-expanded={isShown}
        onClick={() => {
          editing.key.value = isShown ? null : of.name;
        }}
      >
        <StatusMark resolved={resolved} />
        {statusText(path, resolved, scope)}
        {resolved.isPrivate && <span title={say("structure.private")}> 🔒</span>}
      </button>
      {isShown && (
        <>
          <PathStrip model={model} path={path} of={of} editing={editing} resolved={resolved} />
          <StatusMenu editing={editing} path={path} of={of} resolved={resolved} />
        </>
      )}
      {exceptions.length > 0 && (
        <div class="structure-row">
          <span class="structure-legend">{say("structure.exceptions", { branches: exceptions.length })}</span>
          <button type="button" onClick={() => editing.follow(of.name, exceptions)}>
            {say("structure.follow")}
          </button>
        </div>
      )}
    </div>
  );
}

/** How a branch has a value, in a word or two. */
function statusText(path: string, { origin, status }: Resolved, scope: Scope): string {
  if (origin === null) {
    return say("structure.status.standard");
  }
  // What is said for all of its order a branch has not said itself.
  return scope === "branch" && origin === levelOf(path) ? allLike(path) : say(`structure.status.${status}`);
}

/** Filled where the value is said, a ring where it is inherited, half where it is relative. */
function StatusMark({ resolved }: { resolved: Resolved }) {
  return <i class="structure-mark" data-status={resolved.status} aria-hidden="true" />;
}

/** How each branch on the way has a value, so that one sees where it comes from. */
function PathStrip(props: Omit<ValueRowProps, "colours"> & { readonly resolved: Resolved }) {
  const { model, path, of, editing } = props;
  const { origin } = props.resolved;
  return (
    <ol class="structure-strip" aria-label={say("structure.strip")}>
      {wayTo(path).map((step) => {
        const resolved = step === path ? props.resolved : model.resolve(step, of);
        const status = say(`structure.status.${resolved.status}`);
        return (
          <li key={step} data-origin={origin === step}>
            <button
              type="button"
              aria-label={`${titleOf(model, step)}: ${status}${resolved.isPrivate ? `, ${say("structure.private")}` : ""}`}
              onClick={() => editing.choose(step)}
            >
              <StatusMark resolved={resolved} />
              <span>{titleOf(model, step)}</span>
              {resolved.isPrivate && <span aria-hidden="true">🔒</span>}
            </button>
          </li>
        );
      })}
      <li class="quiet">
        {origin === null ? say("structure.origin.default") : say("structure.origin", { branch: sayer(model, origin) })}
      </li>
    </ol>
  );
}

/** Who says a value: a branch, or what is said for all of an order. */
function sayer(model: DesignModel, origin: string): string {
  const [, order] = /^level (\d+)$/.exec(origin) ?? [];
  return order === undefined ? titleOf(model, origin) : say("structure.level", { order });
}

interface StatusMenuProps {
  readonly editing: DesignEditing;
  readonly path: string;
  readonly of: DesignKey;
  readonly resolved: Resolved;
}

/** What can be changed about how a branch has a value. */
function StatusMenu({ editing, path, of, resolved }: StatusMenuProps) {
  if (path === ROOT) {
    return (
      <div class="structure-row">
        <button type="button" disabled={resolved.status === "inherited"} onClick={() => editing.say(of, "inherited")}>
          {say("structure.standard")}
        </button>
      </div>
    );
  }
  const canBeRelative = of.kind === "scalar" || of.kind === "function";
  const isOfOne = editing.scope.value === "branch";
  const relative: readonly Status[] = canBeRelative ? ["offset", "factor"] : [];
  const ways: readonly Status[] = ["inherited", "own", ...relative, ...(isOfOne ? (["shared"] as const) : [])];
  return (
    <div class="structure-menu">
      <fieldset class="structure-ways">
        <legend>{say("structure.status")}</legend>
        {ways.map((way) => (
          <button type="button" key={way} aria-pressed={resolved.status === way} onClick={() => editing.say(of, way)}>
            {say(`structure.status.${way}`)}
          </button>
        ))}
      </fieldset>
      <label class="structure-private">
        <input
          type="checkbox"
          checked={resolved.isPrivate}
          onChange={(event) => editing.hide(of, event.currentTarget.checked)}
        />
        {say("structure.hide")}
      </label>
      {resolved.status !== "own" && resolved.status !== "shared" && (
        <label class="structure-private">
          <input
            type="checkbox"
            checked={resolved.setting?.below === true}
            onChange={(event) => editing.inheritBelow(of, event.currentTarget.checked)}
          />
          {say("structure.below")}
        </label>
      )}
      {isOfOne && bearerOf(path) !== null && resolved.status !== "inherited" && (
        <button type="button" onClick={() => editing.promote(of)}>
          {say("structure.promote")}
        </button>
      )}
    </div>
  );
}
