import { useEffect } from "preact/hooks";
import { DESIGN_TEMPLATES } from "../../document/design/design-keys";
import { ROOT } from "../../document/design/design-model";
import { designOf } from "../../document/design/design-of";
import { limbsOf } from "../../document/design/limbs-of";
import { shapingOf } from "../../document/design/shaping-of";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { Section } from "../controls/section";
import { mountStage } from "../structure/mount-stage";
import { BranchList } from "./structure/branch-list";
import { BranchValues } from "./structure/branch-values";
import { downloadGraph, openGraph } from "./structure/graph-file";

/** A tree that is designed from its outline inwards: its branches, and what is said of them. */
export function StructurePanel({ studio }: { studio: Studio }) {
  const editing = designOf(studio);
  const model = editing.model.value;
  const onTop = model?.told.steps_on_top ?? 0;
  const fits = (studio.document.value?.trials ?? 0) > 0;
  const [shaping, limbs] = [shapingOf(studio), limbsOf(studio)];
  const { bark, leaves } = studio.appearance.value;
  const colours = { bark: bark.tint, leaves: leaves.tint };
  useEffect(() => mountStage(studio), [studio]);
  return (
    <>
      <Section name="structure.begin" title={say("structure.begin")} open={!model}>
        <p class="quiet">{say("structure.begin.help")}</p>
        <div class="structure-templates">
          {DESIGN_TEMPLATES.map((name) => (
            <button
              type="button"
              key={name}
              title={say(`structure.template.${name}.help`)}
              onClick={() => editing.begin(name)}
            >
              <b>{name}</b>
              <span>{say(`structure.template.${name}`)}</span>
            </button>
          ))}
          <button type="button" onClick={() => editing.begin(null)}>
            <b>{say("structure.plain")}</b>
            <span>{say("structure.plain.help")}</span>
          </button>
        </div>
        <div class="structure-row">
          <label class="structure-file">
            {say("structure.open")}
            <input
              type="file"
              accept=".json,application/json"
              onChange={(event) => openGraph(event.currentTarget, editing, (text) => studio.toasts.show(text))}
            />
          </label>
          <button
            type="button"
            title={say("structure.describe.help")}
            disabled={fits}
            onClick={() => editing.describe()}
          >
            {say("structure.describe")}
          </button>
          <button type="button" disabled={!model} onClick={() => model && downloadGraph(model)}>
            {say("structure.download")}
          </button>
        </div>
      </Section>
      {!shaping.isOn.value && (!model || onTop > 0) && (
        <Section name="structure.limbs" title={say("limbs.title")} open>
          <p class="quiet">{say("limbs.help")}</p>
          <button
            type="button"
            class="structure-release"
            aria-pressed={limbs.isOn.value}
            disabled={!studio.rights.mayChange.value}
            onClick={() => {
              limbs.wanted.value = !limbs.isOn.peek();
            }}
          >
            {say("limbs.shape")}
          </button>
        </Section>
      )}
      {model && onTop > 0 && (
        <div class="structure-sealed" role="status">
          <p>{say("structure.sealed", { steps: onTop })}</p>
          <div class="structure-row">
            <button type="button" onClick={() => studio.submit({ kind: "ungrow", steps: Math.min(onTop, 1000) })}>
              {say("structure.sealed.back")}
            </button>
            <button
              type="button"
              title={say("structure.sealed.keep.help")}
              disabled={fits}
              onClick={() => editing.describe(model.told.row)}
            >
              {say("structure.sealed.keep")}
            </button>
            <button type="button" onClick={() => editing.release()}>
              {say("structure.release")}
            </button>
            <button type="button" onClick={() => editing.open(model.graph)}>
              {say("structure.sealed.again")}
            </button>
          </div>
        </div>
      )}
      {model && onTop === 0 && !shaping.wanted.value && (
        <button
          type="button"
          class="structure-release"
          onClick={() => {
            shaping.wanted.value = true;
          }}
        >
          {say("structure.shaping")}
        </button>
      )}
      {model && (
        <>
          <Section name="structure.branches" title={say("structure.branches")} open>
            <p class="quiet">{say("structure.counts", { values: model.told.values, branches: model.told.branches })}</p>
            {model.told.overlap !== undefined && (
              <p class="quiet">{say("structure.overlap", { percent: Math.round(100 * model.told.overlap) })}</p>
            )}
            <BranchList editing={editing} shaping={shaping} model={model} />
          </Section>
          <Section name="structure.values" title={say("structure.values")} open>
            <BranchValues editing={editing} model={model} colours={colours} key={editing.chosen.value} />
          </Section>
          {onTop === 0 && editing.chosen.value === ROOT && (
            <button type="button" class="structure-release" onClick={() => editing.release()}>
              {say("structure.release")}
            </button>
          )}
        </>
      )}
    </>
  );
}
