-- The tag without the difference of large and small letters; none until the program has folded it.
ALTER TABLE tree_tags ADD COLUMN folded TEXT NOT NULL DEFAULT '';

CREATE INDEX tree_tags_by_folded ON tree_tags (folded, tag);
DROP INDEX tree_tags_by_tag;
