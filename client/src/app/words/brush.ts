/** The panel of the brush. */
export const BRUSH = {
  "brush.radius": ["Radius", "Radius"],
  "brush.radius.help": [
    "How wide the brush is, in internodes; at the left end it becomes a pencil that sketches one limb.",
    "Wie breit der Pinsel ist, in Internodien; am linken Ende skizziert er einen einzelnen Ast.",
  ],
  "brush.sketch": ["Sketch", "Skizze"],
  "brush.brush": ["Brush", "Pinsel"],
  "brush.does.sketch": [
    "Sketches one limb, exactly along the stroke.",
    "Skizziert einen einzelnen Ast, genau entlang des Strichs.",
  ],
  "brush.does.narrow": [
    "Leads one limb along the stroke and lets it branch a little.",
    "Führt einen Ast entlang des Strichs und lässt ihn sich etwas verzweigen.",
  ],
  "brush.does.wide": [
    "Fills its sweep with branches, wherever the tree can reach.",
    "Füllt, was er überstreicht, mit Ästen, so weit der Baum reicht.",
  ],
  "brush.picture": [
    "The brush and the markers it sows, beside a shoot of the tree",
    "Der Pinsel und die Marker, die er sät, neben einem Trieb des Baums",
  ],
  "brush.rim": ["Rim of the brush", "Rand des Pinsels"],
  "brush.pressure": ["Pen pressure", "Stiftdruck"],
  "brush.pressure.help": [
    "A pen that is pressed harder draws with a wider brush.",
    "Ein stärker gedrückter Stift zeichnet mit breiterem Pinsel.",
  ],
  "brush.section.stroke": ["What a stroke does", "Was ein Strich bewirkt"],
  "brush.section.branches": ["Which branches grow", "Welche Äste wachsen"],
  "brush.section.lasso": ["Lasso", "Lasso"],
  "brush.section.symmetry": ["Symmetry", "Symmetrie"],
  "brush.symmetry": ["Repeat strokes", "Striche wiederholen"],
  "brush.symmetry.help": [
    "What brush, pencil and lasso draw is repeated about the trunk, all of it as one operation: on its other side as you see it, or around it. While one branch alone grows, nothing is repeated.",
    "Was Pinsel, Stift und Lasso zeichnen, wiederholt sich am Stamm, alles zusammen als ein Arbeitsgang: auf der anderen Seite, wie du ihn siehst, oder ringsum. Solange nur ein Ast wächst, wiederholt sich nichts.",
  ],
  "brush.symmetry.off": ["Off", "Aus"],
  "brush.symmetry.mirror": ["Mirror", "Spiegel"],
  "brush.symmetry.around": ["Around", "Ringsum"],
  "brush.around": ["Times around", "Anzahl ringsum"],
  "brush.around.help": [
    "How often each stroke stands around the trunk.",
    "Wie oft jeder Strich um den Stamm herum steht.",
  ],
  "brush.around-mirrored": ["Mirrored as well", "Auch gespiegelt"],
  "brush.around-mirrored.help": [
    "Each stroke around the trunk also has a mirror image.",
    "Jeder Strich um den Stamm hat auch ein Spiegelbild.",
  ],
  "brush.all-grow": ["Every branch may grow.", "Jeder Ast darf wachsen."],
  "brush.all-grow.how": [
    "To have one alone grow, press and hold it in the picture until the circles close.",
    "Soll einer allein wachsen, halte ihn im Bild, bis sich die Kreise schließen.",
  ],
  "brush.one-grows": ["Only the chosen branch grows.", "Nur der gewählte Ast wächst."],
  "brush.release": ["Let every branch grow", "Alle Äste wachsen lassen"],
  "brush.lasso-depth": ["Depth of the body", "Tiefe des Körpers"],
  "brush.lasso-depth.help": [
    "How deep the body is that an outline becomes: 1 is as deep as wide, less is flat like an espalier.",
    "Wie tief der Körper ist, der aus einem Umriss wird: 1 so tief wie breit, weniger ist flach wie ein Spalier.",
  ],
} as const;
