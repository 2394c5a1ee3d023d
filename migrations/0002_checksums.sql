-- 'ESPL': tells other programs whose file this is, and this one which files are not its own.
PRAGMA application_id = 1163087948;

-- CRC-32 of the key and the contents (server/src/store/seal.rs); rows of the first release have none.
ALTER TABLE journal ADD COLUMN checksum INTEGER;
ALTER TABLE snapshots ADD COLUMN checksum INTEGER;
ALTER TABLE trees ADD COLUMN checksum INTEGER;

-- The simulation that entries were done by and a snapshot was made by; where none is named, the session's.
ALTER TABLE journal ADD COLUMN simulation_version INTEGER;
ALTER TABLE snapshots ADD COLUMN simulation_version INTEGER;

-- What was found damaged, and what followed it: rows of the journal, `first` to `last`, or the snapshot after `last`.
CREATE TABLE set_aside (
    id                 INTEGER PRIMARY KEY,
    session            TEXT    NOT NULL REFERENCES sessions (name) ON DELETE CASCADE,
    first              INTEGER,
    last               INTEGER NOT NULL,
    contents           BLOB    NOT NULL,
    checksum           INTEGER,
    simulation_version INTEGER,
    set_aside_at       TEXT    NOT NULL
) STRICT;

CREATE INDEX set_aside_by_session ON set_aside (session);

-- Pages of the library go by time and identifier.
DROP INDEX trees_by_time;
CREATE INDEX trees_by_time_and_id ON trees (saved_at, id);
