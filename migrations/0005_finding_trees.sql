-- Collections are folders: each lies in another one or in none.
CREATE TABLE collections (
    id     INTEGER PRIMARY KEY,
    key    TEXT NOT NULL UNIQUE,
    parent INTEGER REFERENCES collections (id),
    name   TEXT NOT NULL
) STRICT;

CREATE INDEX collections_by_parent ON collections (parent);

ALTER TABLE trees ADD COLUMN collection INTEGER REFERENCES collections (id);
-- The name as it is sorted, and all that is searched (server/src/store/folding.rs); none until the program has folded it.
ALTER TABLE trees ADD COLUMN folded TEXT NOT NULL DEFAULT '';
ALTER TABLE trees ADD COLUMN search TEXT;

CREATE TABLE tree_tags (
    tree INTEGER NOT NULL REFERENCES trees (id) ON DELETE CASCADE,
    tag  TEXT    NOT NULL,
    PRIMARY KEY (tree, tag)
) STRICT, WITHOUT ROWID;

CREATE INDEX tree_tags_by_tag ON tree_tags (tag);

CREATE TABLE favourites (
    principal TEXT    NOT NULL,
    tree      INTEGER NOT NULL REFERENCES trees (id) ON DELETE CASCADE,
    PRIMARY KEY (principal, tree)
) STRICT, WITHOUT ROWID;

CREATE INDEX favourites_by_tree ON favourites (tree);

CREATE INDEX trees_by_name ON trees (folded, key) WHERE deleted_at IS NULL;
CREATE INDEX trees_by_size ON trees (metamers, key) WHERE deleted_at IS NULL;
CREATE INDEX trees_by_collection ON trees (collection, saved_at, key) WHERE deleted_at IS NULL;
CREATE INDEX trees_by_species ON trees (species, saved_at, key) WHERE deleted_at IS NULL;
CREATE INDEX trees_by_author ON trees (author, saved_at, key) WHERE deleted_at IS NULL;

-- Parts of words of three letters and more; its rows are those of trees.
CREATE VIRTUAL TABLE trees_text USING fts5 (search, content = '', contentless_delete = 1, tokenize = 'trigram');

CREATE TRIGGER trees_text_is_kept AFTER UPDATE OF search ON trees BEGIN
    DELETE FROM trees_text WHERE rowid = old.id;
    INSERT INTO trees_text (rowid, search) VALUES (new.id, new.search);
END;
CREATE TRIGGER trees_text_goes AFTER DELETE ON trees BEGIN
    DELETE FROM trees_text WHERE rowid = old.id;
END;
