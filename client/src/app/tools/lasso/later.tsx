import type { ToolTopic } from "../descriptor";

export const HELP: readonly ToolTopic[] = [
  {
    name: "lasso",
    title: ["Lasso", "Lasso"],
    text: ["Draw an outline: the tree grows to fill it", "Zeichne einen Umriss: Der Baum wächst hinein"],
    words: ["outline fill shape topiary select area crown bucket", "Umriss füllen Form auswählen Fläche Krone"],
  },
];
