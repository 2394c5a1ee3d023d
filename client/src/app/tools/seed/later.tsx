import type { ToolTopic } from "../descriptor";

export const HELP: readonly ToolTopic[] = [
  {
    name: "seed",
    title: ["Plant a seed", "Samen setzen"],
    text: [
      "Tap the ground; trees shade and crowd each other",
      "Auf den Boden tippen; Bäume beschatten und bedrängen einander",
    ],
    words: ["plant several trees forest another second add", "pflanzen mehrere Bäume Wald weiterer zweiter hinzufügen"],
  },
];
