-- Who logs in with a password.
CREATE TABLE users (
    id         INTEGER PRIMARY KEY,
    name       TEXT    NOT NULL,
    -- The name as it is compared: without the difference of large and small letters, and without accents.
    folded     TEXT    NOT NULL UNIQUE,
    role       TEXT    NOT NULL,
    -- The password's hash by Argon2id with its salt, as a PHC string.
    password   TEXT    NOT NULL,
    created_at TEXT    NOT NULL
) STRICT;

-- Whose login it is; the user's role is that of the pass then.
ALTER TABLE passes ADD COLUMN user INTEGER REFERENCES users (id) ON DELETE CASCADE;

CREATE INDEX passes_by_user ON passes (user) WHERE user IS NOT NULL;
