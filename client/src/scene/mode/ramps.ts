/** Colours from low to high, evenly spaced, as sRGB 0 to 1. */
export type Ramp = readonly (readonly [number, number, number])[];

/** Colours every ramp has. */
export const RAMP_COLOURS = 9;

/**
 * Ramps whose lightness climbs steadily, so that they read the same to every kind of eye and in print. From the family
 * of colour maps that N. Smith, S. van der Walt and E. Firing designed for matplotlib, and of J. Nuñez et al. (2018).
 */
export const RAMPS = {
  viridis: ramp("440154 472d7b 3b528b 2c728e 21918c 28ae80 5ec962 addc30 fde725"),
  plasma: ramp("0d0887 4c02a1 7e03a8 aa2395 cc4778 e66c5c f89540 fdc527 f0f921"),
  magma: ramp("140b34 3b0f70 641a80 8c2981 b73779 de4968 f7705c fe9f6d fecf92"),
  cividis: ramp("00224e 1d376c 434e6c 5f636e 7c7b78 9b9476 bcae6c dccb5d fee838"),
} as const satisfies Record<string, Ramp>;

function ramp(colours: string): Ramp {
  return colours.split(" ").map((hex) => {
    const value = Number.parseInt(hex, 16);
    return [(value >> 16) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255] as const;
  });
}

/** A colour as CSS has it. */
export function css([red, green, blue]: Ramp[number]): string {
  return `rgb(${Math.round(red * 255)} ${Math.round(green * 255)} ${Math.round(blue * 255)})`;
}
