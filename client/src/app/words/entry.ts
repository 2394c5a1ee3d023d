/** The page before the door. */
export const ENTRY = {
  "entry.name": ["Espalier", "Espalier"],
  "entry.title": ["You need an invitation", "Du brauchst eine Einladung"],
  "entry.text": [
    "Ask whoever runs Espalier here for one. Scan its code with the camera of this device, or paste its link below.",
    "Bitte die Person darum, die Espalier hier betreibt. Scanne den Code mit der Kamera dieses Geräts oder füge den Link unten ein.",
  ],
  "entry.code": ["Link or code", "Link oder Code"],
  "entry.enter": ["Come in", "Eintreten"],
  "entry.by-password": ["Log in with a password", "Mit Passwort anmelden"],
  "entry.by-code": ["I have a link or a code", "Ich habe einen Link oder Code"],
  "entry.login.title": ["Log in", "Anmelden"],
  "entry.login.name": ["Name", "Name"],
  "entry.login.password": ["Password", "Passwort"],
  "entry.login.enter": ["Log in", "Anmelden"],
  "entry.entering": ["Coming in…", "Du trittst ein…"],
  "entry.host": [
    "You run it? On the computer where it runs this makes a new invitation:",
    "Du betreibst es selbst? Auf dem Rechner, auf dem es läuft, macht dies eine neue Einladung:",
  ],
  "entry.invite": ["espalier invite", "espalier invite"],
} as const;
