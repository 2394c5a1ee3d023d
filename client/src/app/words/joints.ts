/** Long words of labels, and where they may be broken: not every browser knows how to break German. */
const JOINTS: readonly string[] = [
  "Affen-brot-baum",
  "Apikal-dominanz",
  "Blatt-stellung",
  "Blick-winkel",
  "Blüten-farbe",
  "Blüten-kirsche",
  "Dicken-exponent",
  "Ge-fie-dert",
  "Ge-flügelt",
  "Halb-kaskade",
  "Hand-förmig",
  "Hinter-grunds",
  "Inter-nodium",
  "Lanzett-lich",
  "Licht-empfindlich-keit",
  "Marker-alter",
  "Marker-dichte",
  "Photo-tropismus",
  "Pyramiden-pappel",
  "Rinden-farbe",
  "Säulen-zypresse",
  "Schirm-akazie",
  "Sommer-farbe",
  "Trauer-weide",
  "Trieb-spitzen",
  "Ver-schiebung",
  "Verzweigungs-winkel",
  "Wald-kiefer",
  "Wind-flüchter",
  "Wurzel-anlauf",
  "wind-gepeitscht",
];

/** A hyphen that shows only where a line is broken. */
const SOFT = "\u00ad";

const BROKEN = new Map(JOINTS.map((word) => [word.replace(/-(?=\p{Ll})/gu, ""), word.replace(/-(?=\p{Ll})/gu, SOFT)]));

/** A label for the eye, whose long words may be broken; what is read aloud or searched goes without. */
export function softly(label: string): string {
  return label.replace(/\p{L}{7,}/gu, (word) => BROKEN.get(word) ?? word);
}
