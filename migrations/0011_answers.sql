-- Answers to requests that came with a key of their sender's own, so that the same request is answered again and not done
-- again. The columns of the answer are empty while the request is under way. The numbers of rows only grow.
CREATE TABLE answers (
    id      INTEGER PRIMARY KEY AUTOINCREMENT,
    caller  BLOB    NOT NULL,
    key     BLOB    NOT NULL UNIQUE,
    at      TEXT    NOT NULL,
    request BLOB,
    status  INTEGER,
    headers TEXT,
    body    BLOB
) STRICT;

CREATE INDEX answers_of_callers ON answers (caller, id);
CREATE INDEX answers_by_time ON answers (at);
