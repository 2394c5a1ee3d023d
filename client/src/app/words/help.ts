/** The tour, the cards of gestures, and the help that can be searched. */
export const HELP = {
  "help.search": ["Search gestures, tools, parameters, keys", "Gesten, Werkzeuge, Parameter und Tasten suchen"],
  "help.show": ["Show", "Zeigen"],
  "help.show.what": ["Show: {title}", "Zeigen: {title}"],
  "help.found.none": ["Nothing found for “{query}”.", "Nichts gefunden für „{query}“."],
  "help.found.one": ["1 entry found", "1 Eintrag gefunden"],
  "help.found.many": ["{count} entries found", "{count} Einträge gefunden"],
  "help.tour": ["Take the tour", "Rundgang machen"],
  "help.group.gestures": ["Gestures", "Gesten"],
  "help.group.drawing": ["Drawing", "Zeichnen"],
  "help.group.shaping": ["Shaping", "Formen"],
  "help.group.travelling": ["Travelling in time", "Durch die Zeit reisen"],
  "help.group.looking": ["Looking at it", "Ansehen"],
  "help.group.panels": ["Panels", "Tafeln"],
  "help.group.whole": ["The tree as a whole", "Der Baum als Ganzes"],
  "help.group.keys": ["Keys", "Tasten"],
  "help.group.keys.words": ["keyboard shortcut", "Tastatur Tastenkürzel Kurzbefehl"],
  "help.group.controls": ["Parameters and controls", "Parameter und Regler"],

  "help.tour.label": ["A tour in three gestures", "Ein Rundgang in drei Gesten"],
  "help.tour.step": ["{step} of {count}", "{step} von {count}"],
  "help.tour.skip": ["Skip", "Überspringen"],
  "help.tour.next": ["Next", "Weiter"],
  "help.tour.done": ["Start drawing", "Loszeichnen"],
  "help.tour.draw": ["Draw", "Zeichnen"],
  "help.tour.draw.text": [
    "Draw upward from the seedling with one finger. The tree grows into your stroke.",
    "Zeichne mit einem Finger vom Sämling nach oben. Der Baum wächst in deinen Strich.",
  ],
  "help.tour.turn": ["Turn", "Drehen"],
  "help.tour.turn.text": [
    "Pull the strip at the bottom to turn the tree. Your other hand can go on drawing meanwhile.",
    "Ziehe am Streifen unten, um den Baum zu drehen. Die andere Hand kann dabei weiterzeichnen.",
  ],
  "help.tour.grow": ["Grow", "Wachsen"],
  "help.tour.grow.text": [
    "Push the lever up and the tree grows on by itself. Pull it down and it grows backwards.",
    "Schiebe den Hebel nach oben, und der Baum wächst von selbst weiter. Nach unten gezogen wächst er zurück.",
  ],

  "help.card.draw": ["One finger, pen, left button", "Ein Finger, Stift, linke Maustaste"],
  "help.card.draw.text": ["Brush: the tree grows into the stroke", "Pinsel: Der Baum wächst in den Strich"],
  "help.card.draw.words": ["paint pencil", "malen Bleistift"],
  "help.card.move": [
    "Two or three fingers, middle or right button",
    "Zwei oder drei Finger, mittlere oder rechte Taste",
  ],
  "help.card.move.text": [
    "Two move, and zoom as the wheel does; three turn around the tree",
    "Zwei verschieben und vergrößern, wie auch das Rad; drei drehen um den Baum",
  ],
  "help.card.move.words": [
    "pan scroll zoom in out bigger smaller hand",
    "schieben scrollen heranholen größer kleiner Hand",
  ],
  "help.card.turn": ["The strip at the bottom", "Der Streifen unten"],
  "help.card.turn.text": [
    "Turns the tree, also while the other hand draws: strokes then wind around it",
    "Dreht den Baum, auch während die andere Hand zeichnet: Striche winden sich dann herum",
  ],
  "help.card.turn.words": ["rotate spin orbit 3d", "rotieren umkreisen 3D"],
  "help.card.grow": ["Grow, pushed up or pulled down", "Wachsen, nach oben oder unten"],
  "help.card.grow.text": [
    "Grow on alone, or backwards; further is faster",
    "Allein weiter oder zurück; weiter ist schneller",
  ],
  "help.card.grow.words": ["simulate play automatic older age time", "simulieren abspielen automatisch älter Alter"],
  "help.card.hold": ["Press and hold a branch, or Alt click", "Ast gedrückt halten, oder Alt-Klick"],
  "help.card.hold.text": [
    "Only this branch grows, until you hold elsewhere",
    "Nur dieser Ast wächst, bis du woanders hältst",
  ],
  "help.card.hold.words": ["select lock isolate mask only", "auswählen sperren freistellen"],
  "help.card.cut": ["Double tap, double click a branch", "Ast zweimal antippen oder doppelklicken"],
  "help.card.cut.text": ["Cut it off, without leaving the brush", "Schneidet ihn ab, ohne den Pinsel wegzulegen"],
  "help.card.cut.words": ["eraser erase delete remove trim", "Radiergummi radieren löschen entfernen stutzen"],

  "help.topic.travel": ["Drag along the timeline", "An der Zeitleiste ziehen"],
  "help.topic.travel.text": [
    "Travel through growth and edits, back and forth",
    "Durch Wachstum und Eingriffe reisen, vor und zurück",
  ],
  "help.topic.sign": ["Tap a sign on it", "Ein Zeichen darauf antippen"],
  "help.topic.sign.text": [
    "Go to where that was done; rest a finger on it to read what it was and by whom",
    "Dorthin gehen, wo das geschah; den Finger darauf ruhen lassen, um zu lesen, was es war und von wem",
  ],
  "help.topic.fork": ["A fork above it", "Eine Gabel darüber"],
  "help.topic.fork.text": [
    "Other futures: what was ahead when someone went back",
    "Andere Zukünfte: was bevorstand, als jemand zurückging",
  ],
  "help.topic.architecture": ["Architecture", "Architektur"],
  "help.topic.architecture.text": [
    "Species, and everything that says how a tree grows",
    "Arten, und alles, was sagt, wie ein Baum wächst",
  ],
  "help.topic.leaves": ["Leaves", "Laub"],
  "help.topic.leaves.text": ["Leaves, flowers, fruits and the season", "Blätter, Blüten, Früchte und die Jahreszeit"],
  "help.topic.branches": ["Branches", "Äste"],
  "help.topic.branches.text": [
    "Bark, the foot of the trunk, how smooth wood runs",
    "Rinde, Stammfuß, wie glatt das Holz verläuft",
  ],
  "help.topic.background": ["Background", "Hintergrund"],
  "help.topic.background.text": ["Sky, ground and the sun", "Himmel, Boden und Sonne"],
  "help.topic.wind": ["Wind", "Wind"],
  "help.topic.wind.text": ["Trees sway, from a breeze to a storm", "Bäume schwanken, von der Brise bis zum Sturm"],
  "help.topic.scene": ["Scene", "Szene"],
  "help.topic.scene.text": [
    "Walls and models to grow around; drag them",
    "Mauern und Modelle, um die herum es wächst; lassen sich ziehen",
  ],
  "help.topic.hide": ["Hide everything", "Alles ausblenden"],
  "help.topic.hide.text": [
    "Leaves nothing but the tree; the eye in the corner brings everything back",
    "Lässt nur den Baum stehen; das Auge in der Ecke holt alles zurück",
  ],

  "help.topic.undo": ["Undo, redo", "Rückgängig, wiederholen"],
  "help.topic.undo.text": [
    "Takes back what you did last, and brings it again; what others did is theirs. A tap with two fingers undoes, with three it redoes",
    "Nimmt zurück, was du zuletzt getan hast, und holt es wieder; was andere taten, gehört ihnen. Ein Tippen mit zwei Fingern nimmt zurück, mit dreien holt es wieder",
  ],
  "help.topic.undo.words": [
    "back mistake revert two-finger three-finger tap oops step history",
    "zurücknehmen Fehler widerrufen Zweifingertipp antippen Schritt Verlauf",
  ],
  "help.topic.fit": ["Show the whole tree", "Ganzen Baum zeigen"],
  "help.topic.fit.text": [
    "Brings all of it into the picture, where it was lost or is too large",
    "Holt ihn ganz ins Bild, wenn er verloren ging oder zu groß ist",
  ],
  "help.topic.fit.words": [
    "center centre zoom out reset view home lost frame",
    "zentrieren Mitte herauszoomen Ansicht zurücksetzen verloren einpassen",
  ],
  "help.topic.rotation": ["Rotation strip", "Drehstreifen"],
  "help.topic.rotation.text": [
    "Pull it to turn the tree, also while the other hand draws; Home faces the front",
    "Ziehen dreht den Baum, auch während die andere Hand zeichnet; Pos1 zeigt ihn von vorn",
  ],
  "help.topic.rotation.words": [
    "turn rotate view spin camera orbit 3d around",
    "drehen Ansicht Kamera rundherum umkreisen 3D",
  ],
  "help.topic.size": ["Metres and years", "Meter und Jahre"],
  "help.topic.size.text": [
    "Beside the number of metamers stand height, spread and age: each step of growth counts as a year, and how long an internode is in metres is set in Architecture, under Growth",
    "Neben der Zahl der Metamere stehen Höhe, Breite und Alter: Jeder Wachstumsschritt zählt als ein Jahr, und wie lang ein Internodium in Metern ist, steht unter Architektur, Wuchs",
  ],
  "help.topic.size.words": [
    "units scale height tall width age old how big meters",
    "Einheiten Maßstab Höhe hoch Breite Alter alt wie groß",
  ],
  "help.topic.sun": ["The sun", "Die Sonne"],
  "help.topic.sun.text": [
    "Drag the little sun around the tree, or set its place and the time of day in the panel",
    "Zieh die kleine Sonne um den Baum, oder stelle Ort und Tageszeit in der Tafel ein",
  ],
  "help.topic.sun.words": [
    "light shadow day evening dusk lamp brightness night",
    "Licht Schatten Tag Abend Dämmerung Lampe Helligkeit Nacht",
  ],
  "help.topic.draw-modes": ["Draw modes", "Darstellungen"],
  "help.topic.draw-modes.text": [
    "Lit, skeleton, wireframe, or false colours for light, vigor, age and order; beside them lighting, smoothness, texture, shadows, sky and ground, edges and axes, each switched by itself",
    "Im Licht, als Skelett, als Drahtgitter, oder Falschfarben für Licht, Kraft, Alter und Ordnung; daneben Beleuchtung, Rundung, Textur, Schatten, Himmel und Boden, Kanten und Achsen, jedes für sich geschaltet",
  ],
  "help.topic.draw-modes.words": [
    "exposure legend colours way of drawing heat map x-ray view mode flat unlit shading texture background shadow toggle",
    "Belichtung Legende Farben Ansicht Wärmebild Röntgen flach ohne Licht Schattierung Textur Hintergrund Schatten schalten",
  ],
  "help.topic.species": ["Species", "Arten"],
  "help.topic.species.text": [
    "Pick one and the tree grows like it from now on; search by name or botanical name",
    "Wähle eine, und der Baum wächst von nun an wie sie; suche nach Namen oder botanischem Namen",
  ],
  "help.topic.species.words": [
    "preset kind oak birch pine tree type plant willow maple bonsai",
    "Vorlage Baumart Eiche Birke Kiefer Sorte Pflanze Weide Ahorn Bonsai",
  ],
  "help.topic.brush-panel": ["Brush panel", "Pinseltafel"],
  "help.topic.brush-panel.text": [
    "Radius, pen pressure, what a stroke does, which branches grow, depth of the lasso",
    "Radius, Stiftdruck, was ein Strich bewirkt, welche Äste wachsen, Tiefe des Lassos",
  ],
  "help.topic.brush-panel.words": [
    "pen width size bigger smaller thicker brush settings",
    "Breite Größe größer kleiner dicker Pinselgröße",
  ],
  "help.topic.symmetry": ["Symmetry", "Symmetrie"],
  "help.topic.symmetry.text": [
    "Brush, pencil and lasso draw on both sides of the trunk at once, or 2 to 8 times around it; set it in the brush panel or with Y",
    "Pinsel, Stift und Lasso zeichnen auf beiden Seiten des Stamms zugleich oder 2- bis 8-mal ringsum; einzustellen in der Pinseltafel oder mit Y",
  ],
  "help.topic.symmetry.words": [
    "mirror reflect radial kaleidoscope mandala both sides symmetric",
    "spiegeln symmetrisch beidseitig radial Kaleidoskop Mandala",
  ],
  "help.topic.import": ["Import a model", "Modell laden"],
  "help.topic.import.text": [
    "In the panel Scene: a glTF or OBJ file becomes an obstacle to grow around; it can be cancelled on the way",
    "In der Tafel Szene: Eine glTF- oder OBJ-Datei wird zum Hindernis, um das es wächst; unterwegs lässt es sich abbrechen",
  ],
  "help.topic.import.words": [
    "upload file glb gltf obj obstacle",
    "importieren hochladen Datei glb gltf obj Hindernis",
  ],
  "help.topic.new": ["New tree", "Neuer Baum"],
  "help.topic.new.text": [
    "Plants a seed in a scene of its own; asks first where a tree that is not saved should stay",
    "Setzt einen Samen in eine eigene Szene; fragt vorher, wo ein ungespeicherter Baum bleiben soll",
  ],
  "help.topic.new.words": ["start over blank clear reset delete all", "neu anfangen leer alles löschen von vorn"],
  "help.topic.save": ["Save", "Speichern"],
  "help.topic.save.text": [
    "Puts the tree into the library under a name; its link keeps it anyway",
    "Legt den Baum unter einem Namen in die Bibliothek; sein Link behält ihn ohnehin",
  ],
  "help.topic.save.words": ["keep store backup", "sichern ablegen behalten Sicherung"],
  "help.topic.library": ["Library", "Bibliothek"],
  "help.topic.library.text": [
    "Saved trees with all their versions, templates for new ones, and deleted trees that can still be taken back. Words, filters and / find them, and files open as trees. A finger held on trees selects several and drags them into collections; the menu of one has the rest",
    "Gespeicherte Bäume mit allen Versionen, Vorlagen für neue, und gelöschte Bäume, die sich noch zurückholen lassen. Wörter, Filter und / finden sie, und Dateien öffnen sich als Bäume. Ein Finger, der auf Bäumen ruht, wählt mehrere aus und zieht sie in Sammlungen; das Menü eines Baums hat den Rest",
  ],
  "help.topic.library.words": [
    "open load saved unsaved gallery files recent my trees version history compare restore branch template duplicate undelete note search find filter sort tag favourite star collection folder move import scan mtg qsm",
    "öffnen laden gespeichert ungespeichert zuletzt Galerie Dateien meine Bäume Version Verlauf vergleichen wiederherstellen Vorlage duplizieren zurückholen Notiz suchen finden filtern sortieren Tag Favorit Stern Sammlung Ordner verschieben importieren Scan",
  ],
  "help.topic.share": ["Share", "Teilen"],
  "help.topic.share.text": [
    "A link by which others see the tree grow and draw along; and for a saved tree links that let people in for it alone, to look or to draw, for a day up to a year, as a QR code too, listed and revoked there. With people who log in you share trees and collections by name, from their menu in the library",
    "Ein Link, mit dem andere den Baum wachsen sehen und mitzeichnen; und zu einem gespeicherten Baum Links, die Leute nur zu ihm einlassen, zum Ansehen oder Zeichnen, für einen Tag bis ein Jahr, auch als QR-Code, dort aufgelistet und zu widerrufen. Mit allen, die sich anmelden, teilst du Bäume und Sammlungen namentlich, aus deren Menü in der Bibliothek",
  ],
  "help.topic.share.words": [
    "link together people invite collaborate multiplayer url send qr code guest revoke give user group collection",
    "Link zusammen Leute einladen gemeinsam schicken Adresse QR-Code Gast widerrufen geben Gruppe Sammlung",
  ],
  "help.topic.comments": ["Comments", "Kommentare"],
  "help.topic.comments.text": [
    "Say something of a place on a branch: a pin stands there, and goes along as the tree grows and bends. Others answer, and close what is done; a summary of all can be read, sent and printed",
    "Sage etwas zu einer Stelle an einem Ast: dort steht eine Nadel, die mitgeht, wenn der Baum wächst und sich biegt. Andere antworten und schließen, was erledigt ist; eine Zusammenfassung von allem lässt sich lesen, schicken und drucken",
  ],
  "help.topic.comments.words": [
    "note pin thread answer reply review mention feedback discuss summary",
    "Notiz Nadel Faden Antwort Rückmeldung besprechen erwähnen Zusammenfassung",
  ],
  "help.topic.accounts": ["Accounts", "Konten"],
  "help.topic.accounts.text": [
    "Your password, and tokens for programs that act as you; administrators add people and groups there and say who may what (in Settings)",
    "Dein Passwort und Tokens für Programme, die in deinem Namen handeln; wer verwaltet, fügt dort Menschen und Gruppen hinzu und bestimmt, wer was darf (in den Einstellungen)",
  ],
  "help.topic.accounts.words": [
    "user users group groups login log in password role rights permission administrator token api program",
    "Benutzer Nutzer Gruppe Gruppen Anmeldung anmelden Passwort Kennwort Rolle Rechte Erlaubnis Verwaltung Token Programm",
  ],
  "help.topic.people": ["Who is here", "Wer hier ist"],
  "help.topic.people.text": [
    "Others who have this tree open: their pointers in their colours, the tool they hold, and whether they are away. Follow what somebody sees until your first own touch, or bring everyone to what you see",
    "Andere, die diesen Baum offen haben: ihre Zeiger in ihren Farben, das Werkzeug, das sie halten, und ob sie weg sind. Folge dem, was jemand sieht, bis zu deiner ersten eigenen Berührung, oder hole alle zu dem, was du siehst",
  ],
  "help.topic.people.words": [
    "presence cursor pointer colour follow camera gather together collaborate multiplayer name",
    "Anwesenheit Zeiger Cursor Farbe folgen Kamera versammeln zusammen gemeinsam Name",
  ],
  "help.topic.variations": ["Variations", "Variationen"],
  "help.topic.variations.text": [
    "Up to a thousand trees like a species or a saved tree, each from a seed of its own, grown into files of any format while you draw on; the menu of a tree in the library begins them, and their files are kept for an hour",
    "Bis zu tausend Bäume wie eine Art oder ein gespeicherter Baum, jeder aus einem eigenen Samen, als Dateien in jedem Format, während du weiterzeichnest; das Menü eines Baums in der Bibliothek beginnt sie, und ihre Dateien bleiben eine Stunde",
  ],
  "help.topic.variations.words": [
    "many forest batch job random seeds mass export grow fifty",
    "viele Wald Stapel Auftrag zufällig Samen Massen exportieren fünfzig",
  ],
  "help.topic.download": ["Download", "Herunterladen"],
  "help.topic.download.text": [
    "A picture of the view as PNG, the model as glTF, or the skeleton as JSON, named after the tree; a large one shows how far it is and can be cancelled",
    "Ein Bild der Ansicht als PNG, das Modell als glTF oder das Skelett als JSON, nach dem Baum benannt; bei großen zeigt sich der Fortschritt, und er lässt sich abbrechen",
  ],
  "help.topic.download.words": [
    "export gltf glb file model png image picture screenshot photo render print json skeleton blender",
    "exportieren Export glTF glb Datei Modell png Bild Bildschirmfoto Foto Screenshot drucken json Skelett Blender",
  ],
  "help.topic.install": ["Install as an app", "Als App installieren"],
  "help.topic.install.text": [
    "Where the address begins with https or names localhost, the browser can put Espalier on the home screen, and the page opens while the server is away. Over plain http from another device neither works.",
    "Wo die Adresse mit https beginnt oder localhost nennt, kann der Browser Espalier auf den Startbildschirm legen, und die Seite öffnet sich auch ohne Server. Über einfaches http von einem anderen Gerät geht beides nicht.",
  ],
  "help.topic.install.words": ["offline home screen pwa https", "offline Startbildschirm App pwa https"],
  "help.topic.api": ["For programs", "Für Programme"],
  "help.topic.api.text": [
    "Every address of the API, to be read and tried: trees, versions, downloads, species.",
    "Jede Adresse der API zum Lesen und Ausprobieren: Bäume, Versionen, Downloads, Arten.",
  ],
  "help.topic.api.words": [
    "api rest http script program developer openapi",
    "API REST HTTP Skript Programm Entwickler OpenAPI",
  ],
  "help.topic.settings": ["Settings", "Einstellungen"],
  "help.topic.settings.text": [
    "Language, light or dark, side of the tools, pen pressure, whether the view moves back for growth",
    "Sprache, hell oder dunkel, Seite der Werkzeuge, Stiftdruck, ob die Ansicht dem Wachstum Platz macht",
  ],
  "help.topic.settings.words": [
    "language dark theme left hand preferences options configuration left-handed dark mode names labels icons",
    "Sprache dunkel Design linkshändig Optionen Linkshänder Dunkelmodus Namen Beschriftung Symbole",
  ],
  "help.topic.help": ["Help and tour", "Hilfe und Rundgang"],
  "help.topic.help.text": [
    "All of this can be searched; the tour shows three gestures in half a minute",
    "All das lässt sich durchsuchen; der Rundgang zeigt drei Gesten in einer halben Minute",
  ],
  "help.topic.help.words": ["first steps begin tutorial", "erste Schritte Anfang Einführung"],
  "help.topic.travel.words": [
    "timeline history scrub film animation play replay rewind video",
    "Zeitleiste Verlauf Geschichte Animation abspielen zurückspulen Video",
  ],
  "help.topic.sign.words": ["timeline operation", "Zeitleiste Arbeitsgang"],
  "help.topic.fork.words": ["futures branch of time", "Zukunft Zukünfte Gabel"],
  "help.topic.architecture.words": [
    "parameters widgets form growth settings habit shape angle",
    "Parameter Form Wuchs Einstellungen Gestalt Winkel",
  ],
  "help.topic.leaves.words": [
    "foliage flowers fruits season autumn fall spring winter blossom needles",
    "Blätter Blüten Früchte Jahreszeit Herbst Frühling Winter Nadeln",
  ],
  "help.topic.branches.words": ["bark wood trunk texture roots", "Rinde Holz Stamm Textur Wurzeln"],
  "help.topic.background.words": [
    "sky ground studio backdrop environment wallpaper backdrop clouds",
    "Himmel Boden Studio Umgebung Hintergrundbild Wolken",
  ],
  "help.topic.structure": ["Structure", "Aufbau"],
  "help.topic.structure.text": [
    "Design a tree from its outline inwards, as a bonsai, or give a limb that grew another outline",
    "Einen Baum vom Umriss her entwerfen, wie einen Bonsai, oder einem gewachsenen Ast einen anderen Umriss geben",
  ],
  "help.topic.structure.words": [
    "bonsai design silhouette outline hull inherit chokkan",
    "bonsai entwurf umriss silhouette erben chokkan form",
  ],
  "help.topic.grammars": ["Grammars", "Grammatiken"],
  "help.topic.grammars.text": [
    "Write a plant as an L-system. Its depth, Barron’s slider, says how often its rules were used: each is a step of time, and most are many times as large as the one before",
    "Eine Pflanze als L-System schreiben. Ihre Tiefe, Barrons Regler, sagt, wie oft die Regeln angewandt sind: Jede ist ein Schritt der Zeit und meist um ein Vielfaches größer als die davor",
  ],
  "help.topic.grammars.words": [
    "l-system lindenmayer depth slider derive rules axiom turtle cpfg l-py fractal text editor",
    "l-system lindenmayer tiefe regler ableiten regeln axiom schildkröte cpfg l-py fraktal text",
  ],
  "help.topic.wind.words": [
    "sway gust storm breeze air move animation swing compass",
    "schwanken Böe Sturm Brise Luft bewegen Animation schwingen Windrose",
  ],
  "help.topic.scene.words": [
    "obstacles wall ball box model object collision fence house",
    "Hindernisse Mauer Kugel Kasten Modell Gegenstand Zaun Haus",
  ],
  "help.topic.hide.words": [
    "fullscreen clean bare presentation interface zen",
    "Vollbild leer nur Baum Präsentation Oberfläche",
  ],

  "help.key.radius": ["Narrower, wider", "Schmaler, breiter"],
  "help.key.symmetry": ["Symmetry: mirror, around, off", "Symmetrie: gespiegelt, ringsum, aus"],
  "help.key.escape": ["Cancel, stop growing, let go", "Abbrechen, Wachstum anhalten, loslassen"],
  "help.key.grow": ["Grow, ungrow while held", "Gehalten: wachsen, zurückwachsen"],
  "help.key.travel": [
    "A step back, forth; with Shift an operation",
    "Ein Schritt zurück, vor; mit Umschalt ein Arbeitsgang",
  ],
  "help.key.branch": [
    "Hold a branch, turn it; with Shift about itself",
    "Ast fassen, drehen; mit Umschalt um sich selbst",
  ],
  "help.key.turn": ["Turn the tree, where no branch is held", "Den Baum drehen, wenn kein Ast gefasst ist"],
  "help.key.fit": ["Show the whole tree", "Ganzen Baum zeigen"],
  "help.key.draw-mode": ["Draw it in another way", "Anders darstellen"],
  "help.key.shown": ["Switch a part of the picture, all back", "Einen Teil des Bildes schalten, alle zurück"],
  "help.key.wind": ["Hold what the wind moves, let it go", "Anhalten, was der Wind bewegt, loslassen"],
  "help.key.hide": ["Hide everything, bring it back", "Alles ausblenden, wieder einblenden"],
  "help.key.undo": ["Undo, with Shift redo", "Rückgängig, mit Umschalt wiederholen"],
  "help.key.space": ["Held: drag to move", "Gehalten: ziehen verschiebt"],
  "help.key.alt-wheel": ["Radius; twists a branch that is held", "Radius; dreht einen gefassten Ast um sich selbst"],
  "help.key.help": ["This help", "Diese Hilfe"],
  "help.keys.escape": ["Esc", "Esc"],
  "help.keys.undo": ["Ctrl Z", "Strg Z"],
  "help.keys.space": ["Space", "Leertaste"],
  "help.keys.alt-wheel": ["Alt wheel", "Alt Rad"],
} as const;
