-- Studios: users who have a role together. What a user may do is the most of their own role and those of their groups.
CREATE TABLE studios (
    id         INTEGER PRIMARY KEY,
    name       TEXT    NOT NULL,
    -- The name as it is compared: without the difference of large and small letters, and without accents.
    folded     TEXT    NOT NULL UNIQUE,
    role       TEXT    NOT NULL,
    created_at TEXT    NOT NULL
) STRICT;

CREATE TABLE studio_members (
    studio INTEGER NOT NULL REFERENCES studios (id) ON DELETE CASCADE,
    user   INTEGER NOT NULL REFERENCES users (id) ON DELETE CASCADE,
    PRIMARY KEY (studio, user)
) STRICT, WITHOUT ROWID;

CREATE INDEX studio_members_by_user ON studio_members (user);
