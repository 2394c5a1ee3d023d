/** What the page says of itself: how things stand, what has happened, what stands in the way. */
export const NOTICES = {
  "notices.workspace": ["The tree. Draw to make it grow.", "Der Baum. Zeichne, und er wächst."],
  "notices.bud-lost": [
    "The chosen branch is gone; every branch grows again.",
    "Den gewählten Ast gibt es nicht mehr; alle Äste wachsen wieder.",
  ],
  "notices.grown-up": [
    "Grown up, as its species has it. Push again to let it grow on.",
    "Ausgewachsen, wie es die Art vorsieht. Noch einmal drücken lässt weiterwachsen.",
  ],
  "notices.stroke-ended": [
    "The tree went back in time; your stroke ended there.",
    "Der Baum ging in der Zeit zurück; dein Strich endete dort.",
  ],
  "notices.unknown-session": ["This tree is not here", "Diesen Baum gibt es hier nicht"],
  "notices.unknown-session.text": [
    "The link names a tree this server does not know. It may have been started on another machine.",
    "Der Link nennt einen Baum, den dieser Server nicht kennt. Vielleicht wurde er auf einem anderen Rechner begonnen.",
  ],
  "notices.unknown-session.way": ["Plant a new tree", "Neuen Baum pflanzen"],
  "notices.cannot-open": ["This tree cannot be opened", "Dieser Baum lässt sich nicht öffnen"],
  "notices.go-on": ["Go on", "Weitermachen"],
  "notices.only-look": ["Choose a tree", "Wähle einen Baum"],
  "notices.only-look.text": [
    "You are invited to look at the trees of this library, not to draw.",
    "Du bist eingeladen, die Bäume dieser Bibliothek anzusehen, nicht zu zeichnen.",
  ],
  "notices.only-look.way": ["Open the library", "Bibliothek öffnen"],
  "notices.paint-lost": [
    "What paints bark and leaves could not be loaded; until the page is reloaded they stay plain.",
    "Was Rinde und Blätter malt, ließ sich nicht laden; bis die Seite neu geladen wird, bleiben sie schlicht.",
  ],
  "notices.looking-only": ["You may look, not draw", "Du darfst ansehen, nicht zeichnen"],
  "notices.comment-only": ["You may comment, not draw", "Du darfst kommentieren, nicht zeichnen"],
  "notices.may-draw": ["You may draw on this tree now", "Du darfst an diesem Baum jetzt zeichnen"],
  "notices.may-not-draw": [
    "You may no longer draw on this tree: its owner has changed that",
    "Du darfst an diesem Baum nicht mehr zeichnen: Das hat geändert, wem er gehört",
  ],
  "notices.version": ["This page is of another version", "Diese Seite hat eine andere Version"],
  "notices.version.text": [
    "The server and this page do not speak the same version, and loading it again did not help. Wait a minute, then reload.",
    "Server und Seite haben verschiedene Versionen, und neu zu laden hat nicht geholfen. Warte eine Minute und lade dann neu.",
  ],
  "notices.reload": ["Reload", "Neu laden"],
  "notices.parted": [
    "What the server has not got yet of the other tree is kept; it is sent when you open that tree again in this tab.",
    "Was der Server vom anderen Baum noch nicht hat, bleibt erhalten; es wird gesendet, wenn du jenen Baum in diesem Tab wieder öffnest.",
  ],
  "notices.kept-unsaved": [
    "The tree you left is in the library under Unsaved.",
    "Der Baum, den du verlassen hast, ist in der Bibliothek unter Ungespeichert.",
  ],
  "notices.unsaved-gone": ["The server no longer has this tree.", "Der Server hat diesen Baum nicht mehr."],
  "notices.picture-failed": [
    "This device could not make the picture. Try a smaller one.",
    "Dieses Gerät konnte das Bild nicht machen. Versuche es mit einem kleineren.",
  ],
  "notices.part-loading": ["Loading…", "Lädt…"],
  "notices.part-lost": [
    "This part of the page could not be loaded. Is the server still there?",
    "Dieser Teil der Seite ließ sich nicht laden. Ist der Server noch da?",
  ],
  "notices.unread": [
    "The server has a message about this tree, which could not be loaded. Load the page again to read it.",
    "Der Server hat eine Nachricht zu diesem Baum, die sich nicht laden ließ. Lade die Seite neu, um sie zu lesen.",
  ],
  "notices.part-again": ["Try again", "Noch einmal versuchen"],
  "notices.part-replaced": [
    "The server has a newer version of this page. Reload it; your strokes are kept.",
    "Der Server hat eine neuere Version dieser Seite. Lade sie neu; deine Striche bleiben erhalten.",
  ],
  "notices.no-server": ["The server does not answer", "Der Server antwortet nicht"],
  "notices.no-server.text": [
    "Is it running, and is this device in the same network? This page keeps trying.",
    "Läuft er, und ist dieses Gerät im selben Netz? Die Seite versucht es weiter.",
  ],
  "notices.no-webgl": ["This browser cannot draw in 3D", "Dieser Browser kann nicht in 3D zeichnen"],
  "notices.no-webgl.text": [
    "Espalier needs WebGL 2. Try a current Safari, Chrome, Edge or Firefox with graphics acceleration on.",
    "Espalier braucht WebGL 2. Versuche es mit einem aktuellen Safari, Chrome, Edge oder Firefox und eingeschalteter Grafikbeschleunigung.",
  ],
  "notices.no-picture": ["The picture is gone", "Das Bild ist weg"],
  "notices.no-picture.text": [
    "This device has dropped the picture and has not given it back. Reload the page; your strokes are kept.",
    "Dieses Gerät hat das Bild verworfen und nicht zurückgegeben. Lade die Seite neu; deine Striche bleiben erhalten.",
  ],
  "notices.connecting": ["Connecting…", "Verbindet…"],
  "notices.loading": ["Opening the tree, {percent} %", "Der Baum wird geöffnet, {percent} %"],
  "notices.reconnecting": ["Reconnecting… (try {attempt})", "Verbindet wieder… (Versuch {attempt})"],
  "notices.garbled": [
    "What the server sends cannot be read. This page tries again in a while; loading it anew may help.",
    "Was der Server schickt, ist nicht zu lesen. Die Seite versucht es bald wieder; vielleicht hilft es, sie neu zu laden.",
  ],
  "notices.kept": ["your strokes are kept", "deine Striche bleiben erhalten"],
  "notices.held-up": [
    "The tree does not keep up with you: what you do waits, and is done in its order.",
    "Der Baum kommt nicht nach: Was du tust, wartet und geschieht der Reihe nach.",
  ],
  "notices.full": [
    "The tree has all the growth this document holds. Undo or ungrow to draw on.",
    "Der Baum ist so groß, wie dieses Dokument es erlaubt. Mach etwas rückgängig oder lass ihn zurückwachsen, um weiterzuzeichnen.",
  ],
  "notices.people": ["People who have this tree open: {count}", "Diesen Baum haben offen: {count}"],
  "notices.metamer": ["1 metamer", "1 Metamer"],
  "notices.metamers": ["{count} metamers", "{count} Metamere"],
  "notices.metamers.title": [
    "Living metamers: internodes with their buds and leaves",
    "Lebende Metamere: Internodien mit ihren Knospen und Blättern",
  ],
  "notices.size": ["{height} high, {spread} wide, {age}", "{height} hoch, {spread} breit, {age}"],
  "notices.size.ageless": ["{height} high, {spread} wide", "{height} hoch, {spread} breit"],
  "notices.size.title": [
    "The living wood, and the age of the oldest tree: each step of growth counts as a year",
    "Das lebende Holz, und das Alter des ältesten Baums: Jeder Wachstumsschritt zählt als ein Jahr",
  ],
  "notices.looking": ["Looking…", "Sucht…"],
} as const;
