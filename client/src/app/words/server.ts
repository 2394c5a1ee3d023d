/** How the server is, for owners. */
export const SERVER = {
  "server.title": ["The server", "Der Server"],
  "server.up": [
    "Espalier {version}, running for {hours} h {minutes} min, {sockets} sockets open",
    "Espalier {version}, läuft seit {hours} h {minutes} min, {sockets} Sockets offen",
  ],
  "server.memory": ["{taken} of {all} memory taken", "{taken} von {all} Speicher belegt"],
  "server.refused": [
    "There was no memory left {count} times; `--memory` may allow more.",
    "{count}-mal war kein Speicher frei; `--memory` kann mehr erlauben.",
  ],
  "server.session": ["{memory}: {metamers} metamers, {people} people", "{memory}: {metamers} Metamere, {people} Leute"],
  "server.session.own": [", this tree", ", dieser Baum"],
  "server.session.memory": [", growth waits for memory", ", Wachstum wartet auf Speicher"],
  "server.session.crashes": [", waits for an owner after two crashes", ", wartet nach zwei Abstürzen auf ein Wort"],
  "server.more": ["and {count} smaller ones", "und {count} kleinere"],
} as const;
