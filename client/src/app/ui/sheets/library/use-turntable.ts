import { useEffect, useRef, useState } from "preact/hooks";
import { pictureAt, placeOf, SIZE } from "../../../library/turntable";

/** A mouse that only passes by asks for nothing: it stays for so many milliseconds. */
const STAYS = 300;

/** What turns the picture of a tree. */
export interface Turntable {
  /** The strip as it lies now; null while the tree is seen as it was saved. */
  readonly style: Readonly<Record<"backgroundImage" | "backgroundSize" | "backgroundPosition", string>> | null;
  /** It was pushed so far to the right, in its own width. */
  readonly push: (pushed: number) => void;
  /** It is seen as it was saved again. */
  readonly end: () => void;
}

/** Turns a tree by the pictures in a strip, which is loaded when it is first pushed. Where there is none it stays. */
export function useTurntable(strip: string): Turntable {
  const [pushed, setPushed] = useState<number | null>(null);
  const [loaded, setLoaded] = useState("");
  const coming = useRef<HTMLImageElement | null>(null);
  const load = () => {
    if (coming.current !== null || loaded === strip) {
      return;
    }
    const image = new Image();
    coming.current = image;
    image.onload = () => {
      coming.current = null;
      setLoaded(strip);
    };
    image.onerror = () => {
      coming.current = null;
    };
    image.src = strip;
  };
  const drop = () => {
    if (coming.current !== null) {
      // What nobody waits for is not drawn.
      coming.current.onload = null;
      coming.current.onerror = null;
      coming.current.src = "";
      coming.current = null;
    }
  };
  useEffect(() => drop, []);
  return {
    style:
      pushed === null || loaded !== strip
        ? null
        : { backgroundImage: `url("${strip}")`, backgroundSize: SIZE, backgroundPosition: placeOf(pictureAt(pushed)) },
    push: (pushed) => {
      load();
      setPushed(pushed);
    },
    end: () => {
      drop();
      setPushed(null);
    },
  };
}

/** Turns it below a mouse that stays on it, as far as the mouse is from its middle. */
export function useHover({ push, end }: Pick<Turntable, "push" | "end">) {
  const timer = useRef(0);
  const place = useRef(0);
  const turns = useRef(false);
  useEffect(() => () => clearTimeout(timer.current), []);
  return {
    moved: (event: PointerEvent) => {
      // A finger turns it by being moved, and a mouse that drags it turns nothing.
      if (event.pointerType !== "mouse" || event.buttons !== 0) {
        return;
      }
      const { left, width } = (event.currentTarget as HTMLElement).getBoundingClientRect();
      place.current = (event.clientX - left) / width - 0.5;
      if (turns.current) {
        push(place.current);
      } else if (timer.current === 0) {
        timer.current = window.setTimeout(() => {
          turns.current = true;
          push(place.current);
        }, STAYS);
      }
    },
    left: () => {
      clearTimeout(timer.current);
      [timer.current, turns.current] = [0, false];
      end();
    },
  };
}
