import { TreeIcon } from "../icons";

/** The picture of a tree; a drawing where there is none. */
export function TreePicture({ url }: { readonly url: string | undefined }) {
  return url === undefined ? <TreeIcon /> : <img src={url} alt="" loading="lazy" />;
}
