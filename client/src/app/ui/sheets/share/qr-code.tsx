import { useMemo } from "preact/hooks";
import { encodeQR } from "qr";
import { qrPath } from "./qr-path";

/** Scanners want so many light squares around a code. */
const QUIET = 4;

interface QrCodeProps {
  readonly text: string;
  /** What it is, for those who do not see it. */
  readonly label: string;
}

/** A text for a camera; dark on light in every theme, for scanners expect that. */
export function QrCode({ text, label }: QrCodeProps) {
  const rows = useMemo(() => encodeQR(text, "raw", { border: QUIET }), [text]);
  return (
    <svg class="qr" role="img" aria-label={label} viewBox={`0 0 ${rows.length} ${rows.length}`}>
      <path d={qrPath(rows)} />
    </svg>
  );
}
