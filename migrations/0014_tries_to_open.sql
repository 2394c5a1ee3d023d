-- How often a session was to be opened since it last lived: a server that does not outlive it tries no third time.
ALTER TABLE sessions ADD COLUMN tries INTEGER NOT NULL DEFAULT 0;
