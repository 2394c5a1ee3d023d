/** Names of the panels. */
export const PANELS = {
  "panels.architecture": ["Architecture", "Architektur"],
  "panels.brush": ["Brush", "Pinsel"],
  "panels.leaves": ["Leaves", "Laub"],
  "panels.branches": ["Branches", "Äste"],
  "panels.background": ["Background", "Hintergrund"],
  "panels.wind": ["Wind", "Wind"],
  "panels.structure": ["Structure", "Aufbau"],
  "panels.grammars": ["Grammars", "Grammatiken"],
  "panels.comments": ["Comments", "Kommentare"],
  "panels.scene": ["Scene", "Szene"],
} as const;
