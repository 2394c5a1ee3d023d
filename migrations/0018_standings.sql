-- Who is kept out of a tree, or of a session of none, and until when.
CREATE TABLE removals (
    id         TEXT    PRIMARY KEY,
    -- `tree` or `session`, a space, and its key or name.
    room       TEXT    NOT NULL,
    -- Who: as the server knows them, and as they were called.
    person     TEXT    NOT NULL,
    name       TEXT    NOT NULL,
    removed_by TEXT    NOT NULL,
    until      TEXT    NOT NULL,
    -- Whether the link by which they came was revoked at once.
    revoked    INTEGER NOT NULL,
    UNIQUE (room, person)
) STRICT;

-- To whom a tree was handed over: as the server knows them, and as they were called.
ALTER TABLE trees ADD COLUMN owner_person TEXT;
ALTER TABLE trees ADD COLUMN owner_name TEXT;
