-- Sessions: one shared document each, kept as a journal of commands and snapshots that shorten its replay.
CREATE TABLE sessions (
    name               TEXT PRIMARY KEY,
    seed               INTEGER NOT NULL,
    -- The version of the simulation that the journal was made with: another one would grow another plant.
    simulation_version INTEGER NOT NULL,
    created_at         TEXT NOT NULL
) STRICT, WITHOUT ROWID;

-- One row for each durable batch: entries `first` to `last`, as a JSON array of [client, id, command].
CREATE TABLE journal (
    session TEXT    NOT NULL REFERENCES sessions (name) ON DELETE CASCADE,
    first   INTEGER NOT NULL,
    last    INTEGER NOT NULL CHECK (last >= first),
    entries TEXT    NOT NULL,
    PRIMARY KEY (session, first)
) STRICT, WITHOUT ROWID;

-- The state of a session after entry `through`.
CREATE TABLE snapshots (
    session TEXT    NOT NULL REFERENCES sessions (name) ON DELETE CASCADE,
    through INTEGER NOT NULL,
    bytes   BLOB    NOT NULL,
    UNIQUE (session, through)
) STRICT;

-- The library.
CREATE TABLE trees (
    id                 TEXT PRIMARY KEY,
    name               TEXT    NOT NULL,
    metamers           INTEGER NOT NULL,
    saved_at           TEXT    NOT NULL,
    simulation_version INTEGER NOT NULL,
    document           BLOB    NOT NULL,
    thumbnail          BLOB,
    thumbnail_type     TEXT,
    CHECK ((thumbnail IS NULL) = (thumbnail_type IS NULL))
) STRICT;

CREATE INDEX trees_by_time ON trees (saved_at);
