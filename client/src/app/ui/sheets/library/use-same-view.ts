import { useEffect, useState } from "preact/hooks";

/** Pictures that are shown together: the last ones of which all have come; null until any have. */
export function useSameView(wanted: readonly string[] | null): readonly string[] | null {
  const [shown, setShown] = useState<readonly string[] | null>(null);
  const key = wanted?.join(" ") ?? "";
  useEffect(() => {
    const urls = key === "" ? [] : key.split(" ");
    const images = urls.map((url) => Object.assign(new Image(), { src: url }));
    let left = urls.length === 0;
    const done = Promise.all(images.map((image) => image.decode()));
    done.then(
      () => left || setShown(urls),
      // Where one does not come what was shown stays.
      () => {},
    );
    return () => {
      left = true;
      // What nobody waits for any more is not drawn.
      for (const image of images) {
        if (!image.complete) {
          image.src = "";
        }
      }
    };
  }, [key]);
  return shown;
}
