/** What stands in the scene beside the trees. */
export const SCENE = {
  "scene.box": ["Box", "Quader"],
  "scene.sphere": ["Sphere", "Kugel"],
  "scene.wall": ["Wall", "Mauer"],
  "scene.plane": ["Plane", "Ebene"],
  "scene.model": ["Model", "Modell"],
  "scene.model.title": ["A .glb, .gltf or .obj file", "Eine .glb-, .gltf- oder .obj-Datei"],
  "scene.seed": ["Seed", "Samen"],
  "scene.advice": [
    "Trees grow around what stands here, and in its shade. Drag it where it should stand.",
    "Bäume wachsen um das herum, was hier steht, und in seinem Schatten. Ziehe es dorthin, wo es stehen soll.",
  ],
  "scene.remove": ["Remove", "Entfernen"],
  "scene.remove.which": ["Remove {name}", "{name} entfernen"],
  "scene.across": ["Across", "Quer"],
  "scene.across.help": [
    "How far to the right of the first seed it stands, in internodes",
    "Wie weit rechts vom ersten Samen es steht, in Internodien",
  ],
  "scene.up": ["Up", "Hoch"],
  "scene.up.help": [
    "How high its middle is above the ground, in internodes",
    "Wie hoch seine Mitte über dem Boden liegt, in Internodien",
  ],
  "scene.deep": ["Deep", "Tief"],
  "scene.deep.help": [
    "How far in front of the first seed it stands, in internodes",
    "Wie weit vor dem ersten Samen es steht, in Internodien",
  ],
  "scene.turn": ["Turn", "Drehung"],
  "scene.turn.help": ["How far it is turned about the vertical", "Wie weit es um die Senkrechte gedreht ist"],
  "scene.tilt": ["Tilt", "Neigung"],
  "scene.tilt.help": ["How far its right side is lifted", "Wie weit seine rechte Seite angehoben ist"],
  "scene.radius": ["Radius", "Radius"],
  "scene.radius.help": [
    "From its middle to its surface, in internodes",
    "Von der Mitte bis zur Oberfläche, in Internodien",
  ],
  "scene.width": ["Width", "Breite"],
  "scene.width.help": [
    "From its left side to its right, in internodes",
    "Von der linken Seite zur rechten, in Internodien",
  ],
  "scene.height": ["Height", "Höhe"],
  "scene.height.help": [
    "From its lower side to its upper, in internodes",
    "Von der unteren Seite zur oberen, in Internodien",
  ],
  "scene.depth": ["Depth", "Tiefe"],
  "scene.depth.help": ["From its front to its back, in internodes", "Von vorn nach hinten, in Internodien"],
  "scene.no-file": [
    "Choose a .glb, an .obj, or a .gltf together with its .bin files.",
    "Wähle eine .glb-Datei, eine .obj-Datei oder eine .gltf-Datei zusammen mit ihren .bin-Dateien.",
  ],
  "scene.no-gltf": ["{name} is no glTF file.", "{name} ist keine glTF-Datei."],
  "scene.no-place": [
    "This glTF file names no place for its data.",
    "Diese glTF-Datei sagt nicht, wo ihre Daten liegen.",
  ],
  "scene.file-missing": [
    "This model also needs the file {name}; choose both together.",
    "Dieses Modell braucht auch die Datei {name}; wähle beide zusammen.",
  ],
} as const;

/** What is wrong with a mesh that the server sends, or with a model for it. */
export const MESHES = {
  "scene.simplified": [
    "The model has {before} triangles. It was simplified, and {after} of them are kept.",
    "Das Modell hat {before} Dreiecke. Es wurde vereinfacht; {after} davon bleiben.",
  ],
  "scene.too-large": [
    "This model is too large; {limit} MiB is the most.",
    "Dieses Modell ist zu groß; höchstens {limit} MiB sind möglich.",
  ],
  "scene.mesh-short": [
    "The server sent a mesh that is cut short.",
    "Der Server hat ein unvollständiges Netz geschickt.",
  ],
  "scene.mesh-corner": [
    "The server sent a mesh with a corner that is not there.",
    "Der Server hat ein Netz mit einer fehlenden Ecke geschickt.",
  ],
} as const;
