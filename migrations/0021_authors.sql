-- What those are called who have done something in a session: by the key under which journals and lines of time know them.
CREATE TABLE authors (
    author   TEXT PRIMARY KEY,
    -- As the server knows them; nothing once that user is removed, for another one may get the name.
    person   TEXT,
    name     TEXT NOT NULL,
    named_at TEXT NOT NULL
) STRICT, WITHOUT ROWID;
