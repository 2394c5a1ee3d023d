-- What a session must have, so that rows that were lost are noticed: its last entry and its newest snapshot.
ALTER TABLE sessions ADD COLUMN last_entry INTEGER NOT NULL DEFAULT 0;
ALTER TABLE sessions ADD COLUMN last_snapshot INTEGER;
-- What is still to be told to the people of the session, as a JSON array.
ALTER TABLE sessions ADD COLUMN notices TEXT;
-- The program that wrote to the session last.
ALTER TABLE sessions ADD COLUMN written_by TEXT;
-- Over all columns but the time (server/src/store/seal.rs). Rows from before have none until they are next written.
ALTER TABLE sessions ADD COLUMN checksum INTEGER;

UPDATE sessions SET
    last_snapshot = (SELECT max(through) FROM snapshots WHERE session = name),
    last_entry = max(coalesce((SELECT max(last) FROM journal WHERE session = name), 0),
                     coalesce((SELECT max(through) FROM snapshots WHERE session = name), 0));

-- Checksums now cover the version of the simulation and the names of trees as well. No release wrote those of before,
-- and what they did not cover cannot be vouched for now: such rows stand as those of the first release do.
UPDATE journal SET checksum = NULL;
UPDATE snapshots SET checksum = NULL;
UPDATE trees SET checksum = NULL;
