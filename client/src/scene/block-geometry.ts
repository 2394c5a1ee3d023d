import { BufferAttribute, InstancedBufferGeometry } from "three";

/** Vertices that an instance has about: fewer are wasted on some renderers, more on the last of few things. */
const VERTICES = 256;

/** One shape, several times over, so that each instance draws a block of things; see `item-texture.ts`. */
export class BlockGeometry extends InstancedBufferGeometry {
  /** Things that one instance draws. */
  block = 1;
  /** Triangles of one thing. */
  triangles = 0;

  constructor() {
    super();
    this.instanceCount = 0;
  }

  /** Gives it another shape: so many numbers a vertex under this name, and its triangles. */
  shape(name: string, numbers: ArrayLike<number>, size: number, index: readonly number[]): this {
    // What was on the graphics card is of another size.
    this.dispose();
    const vertices = numbers.length / size;
    const block = Math.max(1, Math.floor(VERTICES / vertices));
    const all = new Float32Array(block * numbers.length);
    const items = new Float32Array(2 * block * vertices);
    const triangles: number[] = [];
    for (let item = 0; item < block; item += 1) {
      all.set(numbers, item * numbers.length);
      for (let vertex = 0; vertex < vertices; vertex += 1) items.set([item, block], 2 * (item * vertices + vertex));
      for (const corner of index) triangles.push(item * vertices + corner);
    }
    this.setAttribute(name, new BufferAttribute(all, size));
    this.setAttribute("item", new BufferAttribute(items, 2));
    this.setIndex(triangles);
    this.block = block;
    this.triangles = index.length / 3;
    return this;
  }

  /** Draws so many things. */
  draw(items: number): void {
    this.instanceCount = Math.ceil(items / this.block);
  }
}
