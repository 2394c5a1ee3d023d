import type { Reason } from "../../wire/generated";

const MISUNDERSTOOD = [
  "This page and the server misunderstand each other. Load the page again.",
  "Diese Seite und der Server missverstehen sich. Lade die Seite neu.",
] as const;

/** What a server refuses, by its reasons; `{least}` and `{most}` are of what is allowed. */
export const REFUSALS = {
  "problems.malformed": MISUNDERSTOOD,
  "problems.wrong-method": MISUNDERSTOOD,
  "problems.file-cut-off": [
    "The file did not arrive whole; try again.",
    "Die Datei ist nicht ganz angekommen; versuche es noch einmal.",
  ],
  "problems.not-a-tree-file": ["It cannot become a tree: {cause}.", "Daraus wird kein Baum: {cause}."],
  "problems.not-model": [
    "This is neither a glTF nor an OBJ file. Export the model as .glb or .obj.",
    "Das ist weder eine glTF- noch eine OBJ-Datei. Exportiere das Modell als .glb oder .obj.",
  ],
  "problems.not-gltf": [
    "This is no glTF file. Export the model as .glb.",
    "Das ist keine glTF-Datei. Exportiere das Modell als .glb.",
  ],
  "problems.gltf-version": [
    "The file is glTF {cause}, and only version 2 can be read.",
    "Die Datei ist glTF {cause}, gelesen wird nur Version 2.",
  ],
  "problems.gltf-buffers": [
    "A part of the model lies in another file. Choose both together, or export it as one .glb.",
    "Ein Teil des Modells liegt in einer anderen Datei. Wähle beide zusammen, oder exportiere es als ein .glb.",
  ],
  "problems.gltf-needs": [
    "The file needs {cause}, which cannot be read here. Export it without.",
    "Die Datei braucht {cause}; das wird hier nicht gelesen. Exportiere sie ohne.",
  ],
  "problems.gltf-damaged": [
    "The file is damaged and cannot be an obstacle.",
    "Die Datei ist beschädigt und kann kein Hindernis werden.",
  ],
  "problems.obj-damaged": [
    "The OBJ file cannot be read ({cause}). Export it again.",
    "Die OBJ-Datei lässt sich nicht lesen ({cause}). Exportiere sie noch einmal.",
  ],
  "problems.packed-request": MISUNDERSTOOD,
  "problems.thumbnail-kind": [
    "The picture for the library could not be taken; try again.",
    "Das Bild für die Bibliothek ist nicht gelungen; versuche es noch einmal.",
  ],
  "problems.out-of-range": ["Allowed there: {least} to {most}.", "Möglich ist dort: {least} bis {most}."],
  "problems.too-few": ["That is too little.", "Das ist zu wenig."],
  "problems.off-ground": ["Allowed there: 0, the ground.", "Möglich ist dort: 0, der Boden."],
  "problems.in-obstacle": [
    "Allowed there: a place outside all obstacles.",
    "Möglich ist dort: eine Stelle außerhalb aller Hindernisse.",
  ],
  "problems.no-surface": [
    "This shape cannot be an obstacle: it is too thin, too large or too far away.",
    "Diese Form kann kein Hindernis sein: Sie ist zu dünn, zu groß oder zu weit weg.",
  ],
  "problems.empty-mesh": [
    "The model has no surface: no triangle in it has an area.",
    "Das Modell hat keine Oberfläche: Kein Dreieck darin hat eine Fläche.",
  ],
  "problems.large-mesh": [
    "The model has too many triangles to be read. Simplify it first.",
    "Das Modell hat zu viele Dreiecke, um gelesen zu werden. Vereinfache es zuerst.",
  ],
  "problems.text-length": [
    "Allowed there: {least} to {most} characters.",
    "Möglich ist dort: {least} bis {most} Zeichen.",
  ],
  "problems.text-unseen": ["Allowed there: characters one can see.", "Möglich ist dort: sichtbare Zeichen."],
  "problems.many-words": ["Allowed there: up to {most} words.", "Möglich ist dort: höchstens {most} Wörter."],
  "problems.many-tags": ["Allowed there: up to {most} tags.", "Möglich ist dort: höchstens {most} Tags."],
  "problems.tag-comma": ["Allowed there: a tag without a comma.", "Möglich ist dort: ein Tag ohne Komma."],
  "problems.no-such-option": [
    "This format has no such option, or not in this range.",
    "Dieses Format hat diese Option nicht oder nicht in diesem Bereich.",
  ],
  "problems.too-many": ["That is too much at once; do it in parts.", "Das ist zu viel auf einmal; mach es in Teilen."],
  "problems.behind": [
    "The tree is still growing what was asked for; try again when it has caught up.",
    "Der Baum wächst noch, was verlangt wurde; versuche es wieder, wenn er nachgekommen ist.",
  ],
  "problems.large-file": ["The file is larger than {allowed}.", "Die Datei ist größer als {allowed}."],
  "problems.large-request": [
    "That is more than the server takes at once.",
    "Das ist mehr, als der Server auf einmal annimmt.",
  ],
  "problems.large-thumbnail": [
    "The picture for the library is too large; try again.",
    "Das Bild für die Bibliothek ist zu groß; versuche es noch einmal.",
  ],
  "problems.forbidden": ["You may not do this here.", "Das darfst du hier nicht."],
  "problems.not-let-in": [
    "The server lets in whoever is invited or logs in. Load the page again to come in.",
    "Der Server lässt ein, wer eingeladen ist oder sich anmeldet. Lade die Seite neu, um einzutreten.",
  ],
  "problems.wrong-password": ["The name or the password is wrong.", "Name oder Passwort stimmt nicht."],
  "problems.other-site": [
    "The server takes this for a page of another site. Open the page anew.",
    "Der Server hält dies für eine Seite von anderswo. Öffne die Seite neu.",
  ],
  "problems.unknown-host": [
    "The server is not known by the name in the address. Open it by a name it has, or give it this one with --host-name.",
    "Der Server kennt den Namen in der Adresse nicht als seinen. Öffne ihn unter einem, den er hat, oder gib ihm diesen mit --host-name.",
  ],
  "problems.number-taken": MISUNDERSTOOD,
  "problems.nothing-to-undo": ["There is nothing to undo.", "Es gibt nichts rückgängig zu machen."],
  "problems.nothing-of-yours": [
    "Nothing of yours is left to undo; what others did is theirs. The timeline goes back through everything.",
    "Von dir ist nichts mehr rückgängig zu machen; was andere taten, gehört ihnen. Die Zeitleiste geht durch alles zurück.",
  ],
  "problems.nothing-to-redo": ["There is nothing to redo.", "Es gibt nichts zu wiederholen."],
  "problems.nothing-to-ungrow": [
    "The tree is a seed; it cannot grow back any further.",
    "Der Baum ist ein Samen; weiter kann er nicht zurückwachsen.",
  ],
  "problems.no-dim-branch": ["No branch stands in so little light.", "Kein Ast steht in so wenig Licht."],
  "problems.trunk-turned": [
    "That branch is the foot of a trunk, which cannot be turned.",
    "Dieser Ast ist der Fuß eines Stamms; der lässt sich nicht drehen.",
  ],
  "problems.trunk-moved": [
    "That is the foot of a trunk, which cannot be moved.",
    "Das ist der Fuß eines Stamms; er lässt sich nicht versetzen.",
  ],
  "problems.trunk-cut": [
    "The trunk cannot be cut off: nothing branches off below.",
    "Der Stamm lässt sich nicht abschneiden: Darunter zweigt nichts ab.",
  ],
  "problems.design-sealed": [
    "Something has grown on the designed tree, so its design rests. Undo what grew; or let the design go, and it is wood like any other; or begin another design.",
    "Auf dem entworfenen Baum ist etwas gewachsen, darum ruht der Entwurf. Nimm zurück, was gewachsen ist; oder lass den Entwurf los, dann ist alles gewöhnliches Holz; oder beginne einen anderen Entwurf.",
  ],
  "problems.design-refused": [
    "The design does not take this. Most often it would have too many branches: try a lower density, or fewer orders.",
    "Der Entwurf lässt das nicht zu. Meist hätte er zu viele Äste: versuche es mit geringerer Dichte oder weniger Ordnungen.",
  ],
  "problems.fit-stopped": ["Stopped: the tree is as it was.", "Angehalten: Der Baum ist, wie er war."],
  "problems.being-drawn": [
    "Someone is drawing; wait until the brush is lifted.",
    "Jemand zeichnet gerade; warte, bis der Pinsel abgehoben ist.",
  ],
  "problems.being-bent": [
    "Someone is bending that branch; wait until it is let go.",
    "Jemand biegt diesen Ast gerade; warte, bis er losgelassen wird.",
  ],
  "problems.own-branch": ["A branch cannot be set on itself.", "Ein Ast lässt sich nicht auf sich selbst setzen."],
  "problems.outside-world": ["The branch would leave the world.", "Der Ast würde über den Rand der Welt hinausragen."],
  "problems.no-room": [
    "Nothing can grow into this outline. Draw it around some room.",
    "In diesen Umriss kann nichts wachsen. Zeichne ihn um etwas Raum herum.",
  ],
  "problems.tree-full": [
    "The tree has all the growth this document holds.",
    "Der Baum ist so groß, wie dieses Dokument es erlaubt.",
  ],
  "problems.stopped-growing": [
    "The tree stopped growing before it was as large as asked for.",
    "Der Baum hat aufgehört zu wachsen, bevor er so groß war wie gewünscht.",
  ],
  "problems.strokes-full": [
    "{most} strokes are being drawn already; let go of one first.",
    "Es werden schon {most} Striche gezeichnet; beende zuerst einen.",
  ],
  "problems.bends-full": [
    "{most} branches are being bent already; let go of one first.",
    "Es werden schon {most} Äste gebogen; lass zuerst einen los.",
  ],
  "problems.widths-full": [
    "There are {most} widths set, which is the most. Remove some first.",
    "Es sind schon {most} Dicken festgelegt, mehr geht nicht. Entferne zuerst einige.",
  ],
  "problems.history-full": [
    "The history holds as much moved wood as it can. Undo something first.",
    "Die Vorgeschichte fasst nicht mehr bewegtes Holz. Nimm zuerst etwas zurück.",
  ],
  "problems.obstacles-full": [
    "There are {most} obstacles in the scene; remove one first.",
    "In der Szene sind schon {most} Hindernisse; entferne zuerst eines.",
  ],
  "problems.triangles-full": [
    "All models of the scene and its history together may have {most} triangles; this would be more.",
    "Alle Modelle der Szene und ihrer Vorgeschichte dürfen zusammen {most} Dreiecke haben; so wären es mehr.",
  ],
  "problems.mesh-keeps-shape": [
    "A model keeps its shape; place another one instead.",
    "Ein Modell behält seine Form; stelle stattdessen ein anderes auf.",
  ],
  "problems.not-a-grammar": ["This text is no grammar yet: {cause}", "Dieser Text ist noch keine Grammatik: {cause}"],
  "problems.grammar-ends": [
    "The grammar cannot be derived so far; “Depth” in “Grammars” says why.",
    "So weit lässt sich die Grammatik nicht ableiten; „Tiefe“ unter „Grammatiken“ sagt, warum.",
  ],
  "problems.no-grammar": [
    "No grammar is in force here; plant one first.",
    "Hier gilt keine Grammatik; pflanze zuerst eine.",
  ],
  "problems.no-programme": [
    "The tree has no programme any more that a parameter could follow.",
    "Der Baum hat kein Programm mehr, dem ein Parameter folgen könnte.",
  ],
  "problems.future-damaged": [
    "This future is damaged and cannot be taken up.",
    "Diese Zukunft ist beschädigt und lässt sich nicht aufnehmen.",
  ],
  "problems.tree-locked": [
    "The owner has locked this tree: it can be looked at and commented on.",
    "Dieser Baum ist gesperrt, wer ihn besitzt, hat das so gewollt: Du kannst ihn ansehen und kommentieren.",
  ],
  "problems.removed": [
    "{cause} has removed you from this tree for some hours, up to twelve. Whoever owns it can let you back before. Your other trees are as they were.",
    "{cause} hat dich für einige Stunden, höchstens zwölf, von diesem Baum entfernt. Wer ihn besitzt, kann dich früher zurückholen. Deine anderen Bäume sind wie zuvor.",
  ],
  "problems.removed-guest": [
    "{cause} has removed you from this tree. Your link works no longer; ask for another one if you should come back.",
    "{cause} hat dich von diesem Baum entfernt. Dein Link gilt nicht mehr; bitte um einen neuen, wenn du zurückkommen sollst.",
  ],
  "problems.comment-stays": [
    "A comment can be changed for {least} minutes only. Delete it, or write another one.",
    "Ein Kommentar lässt sich nur {least} Minuten lang ändern. Lösch ihn oder schreib einen neuen.",
  ],
  "problems.not-deleted": ["This tree is not deleted.", "Dieser Baum ist nicht gelöscht."],
  "problems.collection-in-itself": [
    "A collection cannot lie in itself.",
    "Eine Sammlung kann nicht in sich selbst liegen.",
  ],
  "problems.name-taken": [
    "This name is taken already. Choose another one.",
    "Diesen Namen gibt es schon. Wähl einen anderen.",
  ],
  "problems.last-admin": [
    "Nobody else is an administrator. Make somebody else one first.",
    "Es gibt sonst niemanden, der verwaltet. Mach zuerst jemand anderen dazu.",
  ],
  "problems.key-of-another": [
    "Another request had the key of this one.",
    "Eine andere Anfrage hatte schon den Schlüssel von dieser.",
  ],
  "problems.key-under-way": ["This is being done already.", "Das wird gerade schon getan."],
  "problems.answer-not-kept": [
    "This was done already; what came of it is shown once only.",
    "Das wurde schon getan; was dabei herauskam, wird nur einmal gezeigt.",
  ],
  "problems.outcome-unknown": [
    "The server stopped while it did this; look whether it was done.",
    "Der Server hielt währenddessen an; sieh nach, ob es getan wurde.",
  ],
  "problems.nothing-waits": ["Nothing waits to go on here.", "Hier wartet nichts darauf weiterzugehen."],
  "problems.newer-program": [
    "This tree was made by a newer Espalier; the server must be updated to open it.",
    "Diesen Baum hat ein neueres Espalier gemacht; um ihn zu öffnen, muss der Server aktualisiert werden.",
  ],
  "problems.session-damaged": ["The record of this tree is damaged.", "Die Aufzeichnung dieses Baums ist beschädigt."],
  "problems.session-waits": [
    "The server failed twice while it opened this tree. The tree is kept; an owner can let it be tried again.",
    "Der Server ist zweimal daran gescheitert, diesen Baum zu öffnen. Der Baum ist behalten; ein Eigentümer kann es noch einmal versuchen lassen.",
  ],
  "problems.tree-damaged": ["The saved tree is damaged.", "Der gespeicherte Baum ist beschädigt."],
  "problems.branch-gone": [
    "That branch is gone: someone has just cut it, or the tree has shed it.",
    "Diesen Ast gibt es nicht mehr: Jemand hat ihn gerade geschnitten, oder der Baum hat ihn abgeworfen.",
  ],
  "problems.stroke-gone": ["This stroke has ended already.", "Dieser Strich ist schon zu Ende."],
  "problems.bend-gone": [
    "This bend has ended: its branch is gone or has changed.",
    "Dieses Biegen ist zu Ende: Den Ast gibt es nicht mehr, oder er hat sich verändert.",
  ],
  "problems.future-gone": ["This future is no longer kept.", "Diese Zukunft ist nicht mehr aufgehoben."],
  "problems.obstacle-gone": [
    "No obstacle stands there; perhaps someone has just taken it away.",
    "Dort steht kein Hindernis; vielleicht hat es gerade jemand entfernt.",
  ],
  "problems.design-gone": ["There is no design here any more.", "Hier gibt es keinen Entwurf mehr."],
  "problems.design-branch-gone": [
    "The design has no place for this branch now.",
    "Der Entwurf hat für diesen Ast gerade keinen Platz.",
  ],
  "problems.no-template": ["There is no such template.", "Diese Vorlage gibt es nicht."],
  "problems.no-tree": ["This tree is no longer in the library.", "Dieser Baum ist nicht mehr in der Bibliothek."],
  "problems.no-collection": [
    "This collection is no longer in the library.",
    "Diese Sammlung ist nicht mehr in der Bibliothek.",
  ],
  "problems.no-invitation": [
    "This code was used already, is too old or is mistyped. Ask for another one.",
    "Dieser Code ist schon benutzt, zu alt oder vertippt. Bitte um einen neuen.",
  ],
  "problems.too-often": [
    "There were too many tries. The next one is possible in {least} s.",
    "Das waren zu viele Versuche. Der nächste ist in {least} s möglich.",
  ],
  "problems.no-session": [
    "This server does not know the tree of this link.",
    "Dieser Server kennt den Baum zu diesem Link nicht.",
  ],
  "problems.none-such": ["The server does not have this.", "Das hat der Server nicht."],
  "problems.stale": [
    "Somebody else has changed this tree meanwhile. Look at it and try again.",
    "Jemand anders hat diesen Baum inzwischen verändert. Sieh ihn dir an und versuche es noch einmal.",
  ],
  "problems.database-gone": [
    "The server's database file has been moved or deleted. Nothing is kept until it is back; tell whoever runs the server.",
    "Die Datenbankdatei des Servers wurde verschoben oder gelöscht. Bis sie zurück ist, wird nichts gespeichert; sag es dem, der den Server betreibt.",
  ],
  "problems.database-failed": [
    "The server cannot write to its disk; nothing was changed. Is the disk full?",
    "Der Server kann nicht auf seine Platte schreiben; nichts wurde verändert. Ist sie voll?",
  ],
  "problems.stopping": ["The server is stopping.", "Der Server wird gerade beendet."],
  "problems.not-opened": ["The tree cannot be opened now.", "Der Baum lässt sich gerade nicht öffnen."],
  "problems.session-ended": [
    "The server has just put this tree aside; try again.",
    "Der Server hat diesen Baum gerade weggelegt; versuche es noch einmal.",
  ],
  "problems.many-people": ["Too many people are here already.", "Hier sind schon zu viele Leute."],
  "problems.failed": [
    "The server could not compute this; nothing was changed.",
    "Der Server konnte das nicht berechnen; nichts wurde verändert.",
  ],
  "problems.busy": [
    "The server is busy growing trees; the sketch comes later.",
    "Der Server lässt gerade Bäume wachsen; die Skizze kommt später.",
  ],
  "problems.memory-full": [
    "The server has no memory left for this now; nothing was changed. Try again soon.",
    "Der Server hat dafür gerade keinen Speicher frei; nichts wurde verändert. Versuche es gleich noch einmal.",
  ],
  "problems.late": ["The server took too long.", "Der Server hat zu lange gebraucht."],
  "problems.not-placed": ["The obstacle was not placed.", "Das Hindernis wurde nicht aufgestellt."],
  "problems.not-exported": ["The tree cannot be exported.", "Der Baum lässt sich nicht exportieren."],
  "problems.jobs-full": [
    "The server has enough to grow already; try again later.",
    "Der Server hat schon genug zu züchten; versuche es später noch einmal.",
  ],
  "problems.jobs-disk-full": [
    "There is no room on the server's disk for more trees that are grown on request.",
    "Auf der Platte des Servers ist kein Platz für weitere Bäume, die auf Wunsch gezüchtet werden.",
  ],
  "problems.not-drawn": ["This picture cannot be drawn.", "Dieses Bild lässt sich nicht zeichnen."],
} as const satisfies Record<`problems.${Reason}`, readonly [string, string]>;

/** What is said besides: of a field that has better words for a reason, of hints and notices. */
export const PROBLEMS = {
  "problems.too-often.gather": [
    "Everyone was brought to a view just now. Again in {least} s.",
    "Eben wurden alle zu einer Ansicht geholt. Wieder in {least} s.",
  ],
  "problems.out-of-reach": ["No bud is near enough to grow here.", "Keine Knospe ist nah genug, um hier zu wachsen."],
  "problems.nothing-grew": [
    "Nothing could grow here: the space is taken, or something is in the way.",
    "Hier konnte nichts wachsen: Der Platz ist besetzt, oder etwas ist im Weg.",
  ],
  "problems.did-not-reach": [
    "Growth did not get there: something is in the way.",
    "Das Wachstum kam nicht bis dorthin: Etwas ist im Weg.",
  ],
  "problems.regrown": [
    "Another version of Espalier was at work on this tree. The last strokes have been grown again by the rules of this one.",
    "An diesem Baum hat eine andere Version von Espalier gearbeitet. Die letzten Striche sind nach den Regeln von dieser neu gewachsen.",
  ],
  "problems.damaged": [
    "The last part of this tree’s record is damaged, from entry {entry} on. You see the tree as it was before; the rest is kept on the server.",
    "Der letzte Teil der Aufzeichnung dieses Baums ist beschädigt, ab Eintrag {entry}. Du siehst den Baum, wie er davor war; der Rest liegt noch auf dem Server.",
  ],
  "problems.impossible": ["That value is not possible.", "Dieser Wert ist nicht möglich."],
  "problems.no-tree.session": [
    "Save the tree first: what is not saved cannot be handed over.",
    "Speichere den Baum zuerst: Was nicht gespeichert ist, lässt sich nicht übergeben.",
  ],
  "problems.forbidden.role": [
    "You give nobody more than you may yourself, and only owners of the server let others own something. Choose less.",
    "Du gibst niemandem mehr, als du selbst darfst, und nur wer den Server besitzt, lässt andere etwas besitzen. Wähle weniger.",
  ],
  "problems.forbidden.name": [
    "Not with yourself, with a group that you are in, or with somebody who owns it: only owners of the server change that.",
    "Nicht mit dir selbst, mit einer Gruppe, in der du bist, oder mit jemandem, dem es gehört: Das ändern nur die, denen der Server gehört.",
  ],
  "problems.forbidden.member": [
    "Only owners of the server take it back from somebody who owns it.",
    "Nur wem der Server gehört, nimmt es jemandem zurück, dem es gehört.",
  ],
  "problems.forbidden.person": [
    "That goes neither with yourself nor with owners of the tree.",
    "Das geht weder mit dir selbst noch mit denen, denen der Baum gehört.",
  ],
  "problems.forbidden.session": [
    "Only owners of the server hand this tree over, and whoever it was handed over to.",
    "Diesen Baum übergibt nur, wem der Server gehört oder wem der Baum übergeben ist.",
  ],
  "problems.forbidden.collection": [
    "You cannot put this into that collection: others would see it there, or you could do more with it. Owners of the server can.",
    "Du kannst dies nicht in diese Sammlung legen: Andere sähen es dort, oder du dürftest mehr damit. Wem der Server gehört, kann es.",
  ],
  "problems.too-many.tree": [
    "This tree has {most} links already; revoke one first.",
    "Dieser Baum hat schon {most} Links; widerrufe erst einen.",
  ],
  "problems.too-few.outline": [
    "This outline has too few or too many points. Draw it anew, in one go.",
    "Dieser Umriss hat zu wenige oder zu viele Punkte. Zeichne ihn neu, in einem Zug.",
  ],
  "problems.too-many.outline": [
    "This outline has too few or too many points. Draw it anew, in one go.",
    "Dieser Umriss hat zu wenige oder zu viele Punkte. Zeichne ihn neu, in einem Zug.",
  ],
} as const;

/** What a request says that got no answer, or one without a reason. */
export const REQUESTS = {
  "problems.silent": ["The server does not answer. Is it running?", "Der Server antwortet nicht. Läuft er?"],
  "problems.unexplained": [
    "The server answered with status {status} and no reason.",
    "Der Server antwortete mit Status {status} und ohne Grund.",
  ],
} as const;
