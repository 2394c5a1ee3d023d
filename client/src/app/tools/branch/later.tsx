import type { ToolTopic } from "../descriptor";

export { BranchHandle as Marks } from "../../ui/overlays/branch-handle";

export const HELP: readonly ToolTopic[] = [
  {
    name: "branch",
    title: ["Branch", "Ast"],
    text: [
      "Drag turns it about its base, a second finger or the wheel twists; then move or copy it",
      "Ziehen dreht ihn um seinen Ansatz, ein zweiter Finger oder das Rad um sich selbst; dann versetzen oder kopieren",
    ],
    words: [
      "turn move copy graft rotate duplicate clone paste stamp",
      "drehen versetzen kopieren pfropfen duplizieren klonen einfügen",
    ],
  },
];
