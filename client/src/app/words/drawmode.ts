/** Ways to draw the tree, and what their colours mean. */
export const DRAWMODE = {
  "drawmode.lit": ["In the light", "Im Licht"],
  "drawmode.skeleton": ["Skeleton", "Skelett"],
  "drawmode.wireframe": ["Wireframe", "Drahtgitter"],
  "drawmode.exposure": ["Light", "Licht"],
  "drawmode.vigor": ["Vigor", "Wuchskraft"],
  "drawmode.age": ["Age", "Alter"],
  "drawmode.order": ["Order", "Ordnung"],
  "drawmode.lit.lesson": ["The tree as it would look outdoors.", "Der Baum, wie er draußen aussähe."],
  "drawmode.skeleton.lesson": [
    "Every axis as a line: what the simulation knows of the tree.",
    "Jede Achse als Linie: was die Simulation vom Baum weiß.",
  ],
  "drawmode.wireframe.lesson": [
    "The triangles that wood and leaves are drawn with.",
    "Die Dreiecke, aus denen Holz und Blätter gezeichnet sind.",
  ],
  "drawmode.exposure.lesson": [
    "How much light reaches each shoot; in deep shade branches stop growing.",
    "Wie viel Licht jeden Trieb erreicht; im tiefen Schatten wachsen Äste nicht weiter.",
  ],
  "drawmode.vigor.lesson": [
    "Where the tree sends its strength: the most vigorous shoots grow longest.",
    "Wohin der Baum seine Kraft lenkt: die kräftigsten Triebe wachsen am längsten.",
  ],
  "drawmode.age.lesson": [
    "How many steps ago each part grew: the crown is young all around.",
    "Vor wie vielen Schritten jeder Teil wuchs: Jung ist die Krone ringsum.",
  ],
  "drawmode.order.lesson": [
    "How often an axis branched off: the trunk is 0, its limbs are 1, their branches 2.",
    "Wie oft eine Achse abzweigte: der Stamm ist 0, seine Äste 1, deren Zweige 2.",
  ],
  "drawmode.end.shade": ["deep shade", "tiefer Schatten"],
  "drawmode.end.light": ["full light", "volles Licht"],
  "drawmode.end.weak": ["weak", "schwach"],
  "drawmode.end.strong": ["vigorous", "kräftig"],
  "drawmode.end.young": ["new", "neu"],
  "drawmode.end.step": ["1 step", "1 Schritt"],
  "drawmode.end.steps": ["{count} steps", "{count} Schritte"],
  "drawmode.end.trunk": ["0: trunk", "0: Stamm"],
  "drawmode.unseen": [
    "The tree is drawn as “{mode}”, which shows little of what is set here.",
    "Der Baum ist als „{mode}“ dargestellt; davon, was hier eingestellt wird, zeigt das wenig.",
  ],
  "drawmode.back": ["Back to the lit tree", "Zurück zum Baum im Licht"],
} as const;
