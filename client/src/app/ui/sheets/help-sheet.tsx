import { useState } from "preact/hooks";
import { helpGroups, type Subject, searched, type ToolHelp, type TopicGroup } from "../../help/help-topics";
import type { Studio } from "../../studio";
import { type Key, say } from "../../words/say";
import { Icon } from "../icons";
import type { StudioView } from "../part-view";
import { GestureSketch } from "./gesture-sketch";
import { showSubject } from "./show-subject";

/** What is only found by searching; the panels explain it where it stands. */
const SEARCHED_ONLY: Key = "help.group.controls";

/** The help, with what the tools say of themselves. */
export function helpSheet(tools: ToolHelp): StudioView {
  return ({ studio }) => <HelpSheet studio={studio} tools={tools} />;
}

/** Gestures, tools, panels and keys, and all parameters for who searches them. */
function HelpSheet({ studio, tools }: { studio: Studio; tools: ToolHelp }) {
  const [query, setQuery] = useState("");
  const groups = helpGroups(tools);
  const searching = query.trim() !== "";
  const shown = searching ? searched(groups, query) : groups.filter(({ title }) => title !== SEARCHED_ONLY);
  const count = shown.reduce((sum, { topics }) => sum + topics.length, 0);
  return (
    <>
      <div class="help-top">
        <input
          type="search"
          class="help-search"
          aria-label={say("help.search")}
          placeholder={say("help.search")}
          autocomplete="off"
          value={query}
          onInput={(event) => setQuery(event.currentTarget.value)}
        />
        <button
          type="button"
          class="small"
          onClick={() => {
            studio.layout.sheet.value = null;
            studio.layout.bare.value = false;
            studio.tour.start();
          }}
        >
          {say("help.tour")}
        </button>
      </div>
      <p class={searching && count > 0 ? "unseen" : "quiet empty"} role="status" hidden={!searching}>
        {say(count === 0 ? "help.found.none" : count === 1 ? "help.found.one" : "help.found.many", {
          query: query.trim(),
          count,
        })}
      </p>
      <div class="help">
        {shown.map((group) => (
          <Group key={group.title} group={group} onShow={(subject) => showSubject(studio, subject)} />
        ))}
      </div>
    </>
  );
}

interface GroupProps {
  readonly group: TopicGroup;
  readonly onShow: (subject: Subject) => void;
}

function Group({ group: { title, topics }, onShow }: GroupProps) {
  const cards = topics.some(({ sketch }) => sketch !== undefined);
  return (
    <section class={cards ? "help-group cards" : "help-group"}>
      <h3>{say(title)}</h3>
      <dl>
        {topics.map(({ id, title, text, keys, sketch, subject }) => (
          <div key={id} data-topic={id}>
            {sketch && <GestureSketch name={sketch} />}
            <dt>{keys === undefined ? title : <kbd>{keys}</kbd>}</dt>
            <dd>{text}</dd>
            {subject && (
              <dd class="help-show">
                <button
                  type="button"
                  aria-label={say("help.show.what", { title })}
                  title={say("help.show")}
                  onClick={() => onShow(subject)}
                >
                  <GoIcon />
                </button>
              </dd>
            )}
          </div>
        ))}
      </dl>
    </section>
  );
}

const GoIcon = () => (
  <Icon>
    <path d="M5 12h13.5M13 6.5l5.5 5.5-5.5 5.5" />
  </Icon>
);
