-- What versions and snapshots hold is cut into parts by its contents, and each part is kept once: a version that is a
-- stroke later shares nearly all of them with the one before (server/src/store/parts.rs).
CREATE TABLE parts (
    id       INTEGER PRIMARY KEY,
    -- SHA-256 of what is packed.
    hash     BLOB    NOT NULL UNIQUE,
    -- Raw deflate (RFC 1951), and CRC-32 of that.
    packed   BLOB    NOT NULL,
    checksum INTEGER NOT NULL
) STRICT;

-- A document with parts has no bytes of its own. Those of before have bytes and no parts.
CREATE TABLE document_parts (
    document INTEGER NOT NULL REFERENCES documents (id) ON DELETE CASCADE,
    ordinal  INTEGER NOT NULL,
    part     INTEGER NOT NULL REFERENCES parts (id),
    PRIMARY KEY (document, ordinal)
) STRICT, WITHOUT ROWID;

CREATE INDEX document_parts_by_part ON document_parts (part);

-- A snapshot holds a document as well, or bytes of its own where an earlier program wrote it.
ALTER TABLE snapshots ADD COLUMN document INTEGER REFERENCES documents (id);
ALTER TABLE set_aside ADD COLUMN document INTEGER REFERENCES documents (id);

CREATE INDEX snapshots_by_document ON snapshots (document);
CREATE INDEX set_aside_by_document ON set_aside (document);
