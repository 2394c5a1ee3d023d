import { useEffect, useRef } from "preact/hooks";
import type { PinPlace } from "../../../wire/generated";
import { Conversation } from "../../comments/conversation";
import { callsForMe, isUnread } from "../../comments/filters";
import type { Studio } from "../../studio";
import { language, say } from "../../words/say";
import { useAnimationFrames } from "../use-animation-frames";
import { SketchGlass } from "./sketch-glass";

/** The conversation of a page, made once. */
export function conversationOf(studio: Studio): Conversation {
  const { conversation } = studio.comments;
  conversation.value ??= new Conversation(studio);
  return conversation.value;
}

/** Threads at their places on the tree, and what a finger says of the picture while somebody writes. */
export function CommentPins({ studio }: { studio: Studio }) {
  const conversation = conversationOf(studio);
  const layer = useRef<HTMLDivElement>(null);
  const session = studio.link.session.value;
  const phase = studio.link.phase.value;
  const stale = studio.comments.stale.value;
  useEffect(() => {
    if (session !== null && phase === "connected") {
      void conversation.load();
    }
  }, [conversation, session, phase]);
  useEffect(() => {
    if (stale.size > 0) {
      void conversation.refresh();
    }
  }, [conversation, stale]);
  // A thread is open as long as one sees it.
  const open = studio.layout.panel.value === "comments" ? studio.comments.open.value : null;
  const all = [...(conversation.threads.value?.values() ?? [])].filter(
    ({ at, resolved, thread }) => at !== undefined && (resolved === undefined || open === thread),
  );
  useAnimationFrames(all.length > 0, () => {
    const project = studio.stage.projector();
    for (const mark of layer.current?.children ?? []) {
      const thread = conversation.threads.peek()?.get(Number(mark.getAttribute("data-thread")));
      const where = thread && conversation.whereIs(thread);
      const at = where && project?.(where.at);
      set(mark, "data-shown", String(Boolean(at)));
      if (!where || !at) {
        continue;
      }
      const [button, line] = [mark.querySelector("button"), mark.querySelector("line")];
      set(mark, "data-stands", String(where.stands));
      if (button) {
        set(button, "style", `translate: ${at[0].toFixed(1)}px ${at[1].toFixed(1)}px`);
      }
      const below = where.below && project?.(where.below);
      if (line) {
        set(line, "data-shown", String(Boolean(below)));
        const [from, to] = [at, below ?? at];
        for (const [name, value] of Object.entries({ x1: from[0], y1: from[1], x2: to[0], y2: to[1] })) {
          set(line, name, value.toFixed(1));
        }
      }
    }
  });
  return (
    <>
      <div class="comment-pins" ref={layer} lang={language.value}>
        {all.map((thread) => (
          <div
            key={thread.thread}
            class="comment-pin"
            data-thread={thread.thread}
            data-unread={isUnread(thread)}
            data-me={callsForMe(thread)}
          >
            <svg class="overlay" aria-hidden="true">
              <line />
            </svg>
            <button
              type="button"
              aria-label={say("comments.pin", {
                number: thread.thread,
                text: (thread.comments[0]?.text ?? "").slice(0, 60),
              })}
              aria-pressed={open === thread.thread}
              onClick={() => conversation.show(thread)}
            >
              <span>{thread.thread}</span>
            </button>
          </div>
        ))}
      </div>
      {conversation.placing.value && <PlacingGlass studio={studio} conversation={conversation} />}
      {(conversation.sketching.value || conversation.lines.value.length > 0) && (
        <SketchGlass studio={studio} conversation={conversation} />
      )}
    </>
  );
}

/** How far a finger may wander and still mean the place that it came down on, in pixels. */
const TAP = 9;

/** Lies over the picture until a place on the tree was touched, which in wind is another one once the finger is gone. */
function PlacingGlass({ studio, conversation }: { readonly studio: Studio; readonly conversation: Conversation }) {
  const touch = useRef<{ readonly x: number; readonly y: number; readonly pin: PinPlace | null } | null>(null);
  const letGo = useRef(() => {});
  useEffect(() => () => letGo.current(), []);
  const pinAt = ({ currentTarget, clientX, clientY }: PointerEvent) => {
    const { left, top } = (currentTarget as HTMLElement).getBoundingClientRect();
    return conversation.pinAt(clientX - left, clientY - top);
  };
  return (
    <div
      class="comment-glass"
      data-placing
      onPointerDown={(event) => {
        touch.current = { x: event.clientX, y: event.clientY, pin: pinAt(event) };
        letGo.current();
        letGo.current = studio.stage.still();
      }}
      onPointerUp={(event) => {
        const began = touch.current;
        const isTap = began !== null && Math.hypot(event.clientX - began.x, event.clientY - began.y) <= TAP;
        const pin = isTap ? began.pin : pinAt(event);
        touch.current = null;
        letGo.current();
        if (pin) {
          conversation.write({ thread: null, pin });
        } else {
          studio.toasts.show(say("comments.place.none"));
        }
      }}
      onPointerCancel={() => letGo.current()}
    >
      <p class="chip">
        {say("comments.place")}
        <button
          type="button"
          class="chip-stop"
          onPointerDown={(event) => event.stopPropagation()}
          onPointerUp={(event) => event.stopPropagation()}
          onClick={() => conversation.giveUp()}
        >
          {say("comments.cancel")}
        </button>
      </p>
    </div>
  );
}

/** Changes nothing where nothing is new. */
function set(element: Element, name: string, value: string): void {
  if (element.getAttribute(name) !== value) {
    element.setAttribute(name, value);
  }
}
