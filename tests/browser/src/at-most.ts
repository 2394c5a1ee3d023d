/** Waits for an answer, for so many milliseconds at most. */
export async function atMost(limit: number, answer: Promise<unknown>): Promise<void> {
  let timer: NodeJS.Timeout | undefined;
  const enough = new Promise<void>((resolve) => {
    timer = setTimeout(resolve, limit);
  });
  await Promise.race([answer, enough]).finally(() => clearTimeout(timer));
}
