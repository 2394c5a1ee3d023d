/** The shortest and the longest length that was given to anything since it was cleared. */
export class GivenLengths {
  private shortest = Number.POSITIVE_INFINITY;
  private longest = 0;

  /** Takes a length into account; 0 is none. */
  take(length: number): void {
    if (length === 0) return;
    this.shortest = Math.min(this.shortest, length);
    this.longest = Math.max(this.longest, length);
  }

  clear(): void {
    this.shortest = Number.POSITIVE_INFINITY;
    this.longest = 0;
  }

  /** Both, with those of what is as long as the look says. */
  around(usual: number): readonly [shortest: number, longest: number] {
    return [Math.min(usual, this.shortest), Math.max(usual, this.longest)];
  }
}
