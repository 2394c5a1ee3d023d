-- What was given to a user or a group, beside what they may do on the server: a tree, or a collection with all that lies in
-- it and in the collections that lie there.
CREATE TABLE gifts (
    id         INTEGER PRIMARY KEY,
    tree       INTEGER REFERENCES trees (id) ON DELETE CASCADE,
    collection INTEGER REFERENCES collections (id) ON DELETE CASCADE,
    user       INTEGER REFERENCES users (id) ON DELETE CASCADE,
    studio     INTEGER REFERENCES studios (id) ON DELETE CASCADE,
    role       TEXT NOT NULL,
    CHECK ((tree IS NULL) <> (collection IS NULL)),
    CHECK ((user IS NULL) <> (studio IS NULL))
) STRICT;

CREATE INDEX gifts_of_trees ON gifts (tree) WHERE tree IS NOT NULL;
CREATE INDEX gifts_of_collections ON gifts (collection) WHERE collection IS NOT NULL;
CREATE INDEX gifts_to_users ON gifts (user) WHERE user IS NOT NULL;
CREATE INDEX gifts_to_studios ON gifts (studio) WHERE studio IS NOT NULL;

CREATE INDEX trees_by_owner ON trees (owner_person) WHERE owner_person IS NOT NULL;
