-- What was done that somebody may be asked about later. The numbers of rows only grow.
CREATE TABLE audit (
    id      INTEGER PRIMARY KEY AUTOINCREMENT,
    at      TEXT    NOT NULL,
    who     TEXT    NOT NULL,
    address TEXT,
    action  TEXT    NOT NULL,
    object  TEXT,
    outcome TEXT    NOT NULL
) STRICT;
