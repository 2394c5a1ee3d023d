-- An event that comes again and again is one row, with how often and when it came last.
ALTER TABLE audit ADD COLUMN times INTEGER NOT NULL DEFAULT 1;
ALTER TABLE audit ADD COLUMN last_at TEXT;

CREATE INDEX audit_of_people ON audit (who, action, outcome, at);
