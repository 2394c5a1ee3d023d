-- Who has begun a session or been in it. Of sessions from before nobody knows.
CREATE TABLE session_people (
    session TEXT NOT NULL REFERENCES sessions (name) ON DELETE CASCADE,
    person  TEXT NOT NULL,
    PRIMARY KEY (session, person)
) STRICT, WITHOUT ROWID;

-- Living metamers in its newest snapshot.
ALTER TABLE sessions ADD COLUMN metamers INTEGER NOT NULL DEFAULT 0;
-- Whether it was taken off the list; whoever enters it puts it there again.
ALTER TABLE sessions ADD COLUMN forgotten INTEGER NOT NULL DEFAULT 0;
