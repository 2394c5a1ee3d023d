-- A tree has versions. What one holds is kept once, however many versions of however many trees hold it.
CREATE TABLE documents (
    id                 INTEGER PRIMARY KEY,
    -- SHA-256 of the rest (server/src/store/seal.rs); none where an earlier program wrote it.
    hash               BLOB UNIQUE,
    simulation_version INTEGER NOT NULL,
    bytes              BLOB    NOT NULL
) STRICT;

CREATE TABLE pictures (
    id         INTEGER PRIMARY KEY,
    media_type TEXT NOT NULL,
    bytes      BLOB NOT NULL
) STRICT;

DROP INDEX trees_by_time_and_id;
ALTER TABLE trees RENAME TO trees_of_before;

CREATE TABLE trees (
    id             INTEGER PRIMARY KEY,
    key            TEXT    NOT NULL UNIQUE,
    name           TEXT    NOT NULL,
    note           TEXT    NOT NULL DEFAULT '',
    is_template    INTEGER NOT NULL DEFAULT 0,
    origin         TEXT,
    origin_version INTEGER,
    -- The newest version, and what lists tell of it.
    head           INTEGER NOT NULL,
    metamers       INTEGER NOT NULL,
    species        TEXT,
    author         TEXT,
    principal      TEXT,
    has_picture    INTEGER NOT NULL,
    saved_at       TEXT    NOT NULL,
    created_at     TEXT    NOT NULL,
    deleted_at     TEXT,
    -- The session that it was saved from or opened in last.
    session        TEXT REFERENCES sessions (name) ON DELETE SET NULL,
    -- Counted up by each change.
    revision       INTEGER NOT NULL DEFAULT 1,
    -- CRC-32 of key, name and head; none where an earlier program wrote it.
    checksum       INTEGER,
    CHECK ((origin IS NULL) = (origin_version IS NULL))
) STRICT;

CREATE TABLE versions (
    tree      INTEGER NOT NULL REFERENCES trees (id) ON DELETE CASCADE,
    number    INTEGER NOT NULL,
    document  INTEGER NOT NULL REFERENCES documents (id),
    picture   INTEGER REFERENCES pictures (id),
    metamers  INTEGER NOT NULL,
    species   TEXT,
    restored  INTEGER,
    author    TEXT,
    principal TEXT,
    note      TEXT    NOT NULL DEFAULT '',
    saved_at  TEXT    NOT NULL,
    -- CRC-32 of the tree's key, the number and the document's hash; none where an earlier program wrote it.
    checksum  INTEGER,
    PRIMARY KEY (tree, number)
) STRICT, WITHOUT ROWID;

CREATE INDEX versions_by_document ON versions (document);
CREATE INDEX versions_by_picture ON versions (picture);

-- Checksums of before covered all in one row. No release wrote them, so these rows stand as the first release's do.
INSERT INTO documents (id, simulation_version, bytes)
    SELECT rowid, simulation_version, document FROM trees_of_before;
INSERT INTO pictures (id, media_type, bytes)
    SELECT rowid, thumbnail_type, thumbnail FROM trees_of_before WHERE thumbnail IS NOT NULL;
INSERT INTO trees (id, key, name, head, metamers, has_picture, saved_at, created_at)
    SELECT rowid, id, name, 1, metamers, thumbnail IS NOT NULL, saved_at, saved_at FROM trees_of_before;
INSERT INTO versions (tree, number, document, picture, metamers, saved_at)
    SELECT rowid, 1, rowid, iif(thumbnail IS NULL, NULL, rowid), metamers, saved_at FROM trees_of_before;
DROP TABLE trees_of_before;

CREATE INDEX trees_by_time ON trees (saved_at, key) WHERE deleted_at IS NULL;
CREATE INDEX trees_deleted ON trees (deleted_at) WHERE deleted_at IS NOT NULL;
CREATE INDEX trees_by_session ON trees (session);

-- The tree that a session belongs to, and up to which entry its journal is in a version of it. What it began with
-- needs no saving.
ALTER TABLE sessions ADD COLUMN tree INTEGER REFERENCES trees (id) ON DELETE SET NULL;
ALTER TABLE sessions ADD COLUMN tree_version INTEGER;
ALTER TABLE sessions ADD COLUMN saved_through INTEGER NOT NULL DEFAULT 0;
-- Who began it.
ALTER TABLE sessions ADD COLUMN principal TEXT;

CREATE INDEX sessions_by_tree ON sessions (tree);
