-- When somebody entered a session or drew in it last. Those of before count from now on.
ALTER TABLE sessions ADD COLUMN entered_at TEXT NOT NULL DEFAULT '';

UPDATE sessions SET entered_at = strftime('%Y-%m-%dT%H:%M:%fZ', 'now');

CREATE INDEX sessions_by_entering ON sessions (entered_at);
