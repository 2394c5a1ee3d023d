-- How a part is packed: 0 is raw deflate (RFC 1951), as all were, 1 is one frame of Zstandard (RFC 8878), which takes a
-- seventh of the time to pack and a third to unpack (docs/performance.md).
ALTER TABLE parts ADD COLUMN packing INTEGER NOT NULL DEFAULT 0;
