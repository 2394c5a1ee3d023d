import { useEffect } from "preact/hooks";
import { grammarsOf } from "../../document/grammar/grammars-of";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { DepthTab } from "./grammars/depth-tab";
import { GrammarEditor } from "./grammars/grammar-editor";
import { GrammarGrid } from "./grammars/grammar-grid";
import { followKeyboard } from "./grammars/screen-keyboard";
import { useSpaceShown } from "./grammars/space-field";
import { TABS, tab } from "./grammars/tab";

/** Plants that are written: grammars to pick from, the text of the one in force, its depth and sliders. */
export function GrammarsPanel({ studio }: { studio: Studio }) {
  const grammars = grammarsOf(studio);
  const shown = tab.value ?? (studio.grammar.inForce.value === null ? "pick" : "text");
  useEffect(() => followKeyboard(), []);
  useSpaceShown(studio);
  return (
    <div class="grammars" data-tab={shown}>
      <div class="tabs three" role="tablist" aria-label={say("grammars.tabs")} onKeyDown={onTabKey}>
        {TABS.map((name) => (
          <button
            type="button"
            role="tab"
            key={name}
            id={`grammars-tab-${name}`}
            aria-selected={shown === name}
            aria-controls="grammars-shown"
            tabIndex={shown === name ? 0 : -1}
            onClick={() => {
              tab.value = name;
            }}
          >
            {say(`grammars.tab.${name}`)}
          </button>
        ))}
      </div>
      <div class="grammars-shown" id="grammars-shown" role="tabpanel" aria-labelledby={`grammars-tab-${shown}`}>
        {shown === "pick" && <GrammarGrid studio={studio} grammars={grammars} />}
        {shown === "text" && <GrammarEditor studio={studio} grammars={grammars} />}
        {shown === "depth" && <DepthTab studio={studio} grammars={grammars} />}
      </div>
    </div>
  );
}

/** The arrow keys go from tab to tab. */
function onTabKey(event: KeyboardEvent) {
  const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
  const at = TABS.findIndex((name) => `grammars-tab-${name}` === document.activeElement?.id);
  if (by !== undefined && at >= 0) {
    const next = TABS[(at + by + TABS.length) % TABS.length]!;
    tab.value = next;
    document.getElementById(`grammars-tab-${next}`)?.focus();
    event.preventDefault();
  }
}
