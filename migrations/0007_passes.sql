-- What lets somebody in: invitations that the first to redeem them turns into a device, devices, and tokens of programs.
CREATE TABLE passes (
    id         TEXT    PRIMARY KEY,
    -- SHA-256 of the secret, which is kept nowhere.
    hash       BLOB    NOT NULL UNIQUE,
    kind       TEXT    NOT NULL,
    -- How people call it.
    name       TEXT    NOT NULL,
    role       TEXT    NOT NULL,
    -- The only tree that it leads to; to all of them if there is none.
    tree       INTEGER REFERENCES trees (id) ON DELETE CASCADE,
    created_at TEXT    NOT NULL,
    -- From then on it lets nobody in. What is used lasts longer, up to the time when it ends for good.
    expires_at TEXT    NOT NULL,
    -- When it ends for good; for an invitation, when what comes of it does.
    ends_at    TEXT    NOT NULL
) STRICT, WITHOUT ROWID;

CREATE INDEX passes_by_time ON passes (expires_at);
CREATE INDEX passes_by_tree ON passes (tree) WHERE tree IS NOT NULL;
