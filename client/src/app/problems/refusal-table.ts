import type { Key } from "../words/say";

/** What the server says in English, and the same among our words; `limit`, `cause` and the like are parts of it. */
export const REFUSALS: readonly (readonly [RegExp, Key])[] = [
  // A file may be at fault in whatever way.
  [/^The file cannot become a tree: (?<cause>[\s\S]*)\.$/, "problems.no-tree-file"],

  // The tree and its branches.
  [/^there is no living metamer with row/, "problems.branch-gone"],
  [/nothing to undo/, "problems.nothing-to-undo"],
  [/nothing to redo/, "problems.nothing-to-redo"],
  [/nothing to ungrow/, "problems.nothing-to-ungrow"],
  [/stands in so little light/, "problems.no-dim-branch"],
  [/foot of a trunk, which cannot be turned/, "problems.trunk-foot"],
  [/foot of a trunk, which cannot be/, "problems.trunk-moved"],
  [/^row \d+ cannot be cut/, "problems.trunk-cut"],
  [/is being bent/, "problems.being-bent"],
  [/very branch that begins/, "problems.own-branch"],
  [/leave the world/, "problems.world"],
  [/nothing can grow into this/, "problems.outline"],
  [/^outline has \d+ entries/, "problems.outline-points"],
  [/(?<limit>\d+) may be; remove some first/, "problems.widths"],
  [/there is no programme that/, "problems.no-programme"],
  [/places of wood that was moved/, "problems.places"],
  [/metamers, its budget is|more metamers than its budget/, "problems.full"],
  [/^(?<limit>\d+) strokes are in progress/, "problems.strokes"],
  [/^(?<limit>\d+) bends are in progress/, "problems.bends"],
  [/^there is no stroke/, "problems.stroke-gone"],
  [/^bend \d+ is not in progress/, "problems.bend-gone"],
  [/^there is no future/, "problems.future-gone"],
  [/^future \d+ is damaged/, "problems.future-damaged"],
  [/ has \d+ entries; allowed/, "problems.too-much"],
  [/^too many commands wait/, "problems.behind"],

  // Obstacles and files.
  [/the scene has (?<limit>\d+) obstacles/, "problems.obstacles"],
  [/^there is no obstacle/, "problems.obstacle-gone"],
  [/a mesh keeps its shape$/, "problems.mesh-keeps-shape"],
  [/history may have (?<limit>\d+) triangles/, "problems.triangles"],
  [/^The obstacle was not placed/, "problems.obstacle-not-placed"],
  [/is not a glTF file/, "problems.file.kind"],
  [/it is glTF (?<version>[^,]*), and version 2/, "problems.file.version"],
  [/lies in another file/, "problems.file.apart"],
  [/it needs (?<needs>[^,]*), which is not read/, "problems.file.needs"],
  [/shows no triangles|no triangles with an area/, "problems.file.empty"],
  [/has more than (?<limit>\d+) triangles|has \d+ triangles; at most (?<most>\d+)/, "problems.file.large"],
  [/mesh has \d+ \w+; allowed/, "problems.file.large"],
  [/^The file cannot be an obstacle|mesh cannot be read/, "problems.file.damaged"],
  [/^the shape cannot be an obstacle/, "problems.shape"],
  [/^The file is larger than (?<allowed>.*)\.$/, "problems.file.bytes"],
  [/^The file did not arrive whole/, "problems.file.parts"],

  // Sessions and the library.
  [/too many people/i, "problems.people"],
  [/^There is no such tree/, "problems.no-tree"],
  [/^There is no such session/, "problems.no-session"],
  [/^There is no such/, "problems.none-such"],
  [/^A collection cannot lie in itself/, "problems.in-itself"],
  [/^A newer Espalier/, "problems.newer"],
  [/^The session is damaged|^The session cannot be restored/, "problems.session-damaged"],
  [/^You may not/, "problems.forbidden"],
  [/^thumbnail is/, "problems.thumbnail"],
  [/^The tree cannot be read/, "problems.tree-damaged"],
  [/^Somebody else has changed the tree/, "problems.stale"],
  [/^The export cannot be done/, "problems.export-option"],
  [/^The tree cannot be exported/, "problems.not-exported"],
  [/^The picture cannot be drawn/, "problems.no-picture"],
  [/^The session cannot be opened/, "problems.not-opened"],
  [/^The session has just ended/, "problems.ended"],
  [/^The request is too large/, "problems.too-large"],

  // The server itself.
  [/database file has been moved/, "problems.database-gone"],
  [/cannot use its database|could not write to its disk/, "problems.disk"],
  [/^The server is stopping/, "problems.stopping"],
  [/^The server failed to compute/, "problems.failed"],
  [/^The server is busy growing/, "problems.schematic-late"],
  [/^The request took too long/, "problems.late"],

  // What only a page says that does not fit the server.
  [/has begun already|^command \d+ was refused before|^the command has number/, "problems.page"],
];

/** What may stand where a value is not allowed, as the server lists it, and the same among our words. */
export const ALLOWED: readonly (readonly [RegExp, Key])[] = [
  [/^(?<least>-?[\d.]+), the ground$/, "problems.allowed.ground"],
  [/^a place outside all obstacles$/, "problems.allowed.outside"],
  [/^box, sphere or plane$/, "problems.allowed.simple-shapes"],
  [/^characters one can see/, "problems.allowed.plain"],
  [/^(?<least>-?[\d.]+) to (?<most>-?[\d.]+) characters$/, "problems.allowed.characters"],
  [/^(?<least>-?[\d.]+) to (?<most>-?[\d.]+), or null$/, "problems.allowed.range"],
  [/^(?<least>-?[\d.]+) to (?<most>-?[\d.]+)$/, "problems.allowed.range"],
  [/^up to (?<most>-?[\d.]+) characters$/, "problems.allowed.most-characters"],
  [/^up to (?<most>\d+) words$/, "problems.allowed.most-words"],
  [/^up to (?<most>\d+) tags$/, "problems.allowed.most-tags"],
  [/^no comma$/, "problems.allowed.no-comma"],
  [/^up to (?<most>-?[\d.]+)$/, "problems.allowed.most"],
];
