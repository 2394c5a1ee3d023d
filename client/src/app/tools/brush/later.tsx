import type { ToolTopic } from "../descriptor";

export const HELP: readonly ToolTopic[] = [
  {
    name: "brush",
    title: ["Brush", "Pinsel"],
    text: ["Draw upward: the tree grows into the stroke", "Zeichne nach oben: Der Baum wächst in den Strich"],
    words: ["paint sketch stroke pen draw grow crayon", "malen Strich Stift zeichnen wachsen Kreide"],
  },
  {
    name: "depth",
    title: ["Begin on a branch", "Auf einem Ast beginnen"],
    text: ["Draw at that branch’s depth", "Zeichnet in der Tiefe dieses Astes"],
    words: ["behind front", "hinten vorn"],
  },
  {
    name: "rest",
    title: ["Rest the finger", "Den Finger ruhen lassen"],
    text: ["Growth goes on under it", "Darunter wächst es weiter"],
    words: ["wait hold still", "warten stillhalten"],
  },
  {
    name: "sketch",
    title: ["Radius at the bottom", "Radius ganz unten"],
    text: ["Sketch: one limb, exactly along the stroke", "Skizze: ein einzelner Ast, genau dem Strich nach"],
    words: ["pencil thin limb line exact", "Stift dünn einzelner Ast Linie genau Bleistift"],
    place: "radius",
  },
];
