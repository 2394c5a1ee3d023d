import { useEffect, useRef } from "preact/hooks";
import { parameterOf, SECTIONS, WIDGETS } from "../../document/growth/growth-parameters";
import { speciesName } from "../../document/species/species-choice";
import type { Studio } from "../../studio";
import { type Key, say } from "../../words/say";
import { Section } from "../controls/section";
import { ForkWidget } from "./architecture/fork-widget";
import { PerceptionWidget } from "./architecture/perception-widget";
import { ProgrammeSection } from "./architecture/programme-section";
import { SchematicTree } from "./architecture/schematic-tree";
import { SidesWidget } from "./architecture/sides-widget";
import { SpeciesGrid } from "./architecture/species-grid";
import { kinNow, useSpecies } from "./architecture/species-list";
import { TABS, tab } from "./architecture/tab";
import { WeightsWidget } from "./architecture/weights-widget";
import { WidgetFrame } from "./architecture/widget";
import { ParameterControl } from "./parameter-control";

/** What trees grow by (TreeSketch §3.4): a small tree that shows it, species, widgets to pull at, and sliders. */
export function ArchitecturePanel({ studio }: { studio: Studio }) {
  useSpecies(studio);
  const shown = tab.value;
  const body = useRef<HTMLDivElement>(null);
  // Another tab is read from its beginning.
  useEffect(() => {
    body.current?.parentElement?.scrollTo({ top: 0 });
  }, [shown]);
  return (
    <div class="architecture" ref={body}>
      <div class="architecture-parts">
        <div class="architecture-top">
          <div class="sketch">
            <SchematicTree studio={studio} />
            <Origin studio={studio} />
          </div>
          <div class="tabs three" role="tablist" aria-label={say("architecture.tabs")} onKeyDown={onTabKey}>
            {TABS.map((name) => (
              <button
                type="button"
                role="tab"
                key={name}
                id={`architecture-tab-${name}`}
                aria-selected={shown === name}
                aria-controls="architecture-shown"
                tabIndex={shown === name ? 0 : -1}
                onClick={() => {
                  tab.value = name;
                }}
              >
                {say(`architecture.tab.${name}`)}
              </button>
            ))}
          </div>
        </div>
        <div id="architecture-shown" role="tabpanel" aria-labelledby={`architecture-tab-${shown}`}>
          {shown === "species" && <SpeciesGrid studio={studio} />}
          {shown === "form" && <Form studio={studio} />}
          {shown === "growth" && <Growth studio={studio} />}
        </div>
      </div>
    </div>
  );
}

/** The arrow keys go from tab to tab. */
function onTabKey(event: KeyboardEvent) {
  const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
  if (by !== undefined) {
    const next = TABS[(TABS.indexOf(tab.peek()) + by + TABS.length) % TABS.length]!;
    tab.value = next;
    document.getElementById(`architecture-tab-${next}`)?.focus();
    event.preventDefault();
  }
}

/** The species that what is set comes from; touched, it shows the others. */
function Origin({ studio }: { studio: Studio }) {
  const kin = kinNow(studio);
  const own = kin === null ? say("architecture.own") : speciesName(kin.species);
  const name = kin?.changed ? say("architecture.changed", { name: own }) : own;
  return (
    <button
      type="button"
      class="origin"
      aria-label={say("architecture.choose-species", { name })}
      onClick={() => {
        tab.value = "species";
      }}
    >
      <span>{name}</span>
    </button>
  );
}

function Form({ studio }: { studio: Studio }) {
  return (
    <>
      <WidgetFrame
        studio={studio}
        title={say("architecture.tropism")}
        help={say("architecture.tropism.help")}
        parameters={WIDGETS.tropism}
        more={<ParameterControl studio={studio} parameter={parameterOf("tropism_from_stroke")} />}
      />
      <ForkWidget studio={studio} />
      <WeightsWidget studio={studio} />
      <SidesWidget studio={studio} />
      <PerceptionWidget studio={studio} />
    </>
  );
}

function Growth({ studio }: { studio: Studio }) {
  const [first, ...others] = SECTIONS;
  const controls = (section: (typeof SECTIONS)[number] | undefined) =>
    section?.parameters.map((parameter) => (
      <ParameterControl studio={studio} parameter={parameter} key={parameter.name} />
    ));
  return (
    <>
      <Section name="architecture.programme" title={say("architecture.programme")} open>
        <ProgrammeSection studio={studio} />
      </Section>
      {controls(first)}
      {others.map((section) => (
        <Section name={section.title} title={say(section.title as Key)} key={section.title}>
          {controls(section)}
        </Section>
      ))}
    </>
  );
}
