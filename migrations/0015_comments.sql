-- What people say of trees: threads of comments, each pinned to a place on the wood or about the tree as a whole.
CREATE TABLE threads (
    id          INTEGER PRIMARY KEY,
    tree        INTEGER NOT NULL REFERENCES trees (id) ON DELETE CASCADE,
    number      INTEGER NOT NULL,
    -- Where it is pinned, as JSON.
    pin         TEXT,
    -- Who has said that it is done, and when.
    resolved_by TEXT,
    resolved_at TEXT,
    UNIQUE (tree, number)
) STRICT;

CREATE TABLE comments (
    id         INTEGER PRIMARY KEY,
    thread     INTEGER NOT NULL REFERENCES threads (id) ON DELETE CASCADE,
    number     INTEGER NOT NULL,
    -- Who wrote it: as the server knows them, and as they were called.
    person     TEXT    NOT NULL,
    author     TEXT    NOT NULL,
    written_at TEXT    NOT NULL,
    edited_at  TEXT,
    -- Its words, and what was seen, as JSON; nothing of one that was deleted.
    said       TEXT,
    media_type TEXT,
    picture    BLOB,
    UNIQUE (thread, number)
) STRICT;

-- The newest comment of a thread that somebody has seen.
CREATE TABLE comments_seen (
    thread INTEGER NOT NULL REFERENCES threads (id) ON DELETE CASCADE,
    person TEXT    NOT NULL,
    seen   INTEGER NOT NULL,
    PRIMARY KEY (thread, person)
) STRICT, WITHOUT ROWID;
