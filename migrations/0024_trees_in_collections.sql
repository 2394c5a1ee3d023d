-- What lies in a collection, deleted trees too: what somebody was given is looked up there.
CREATE INDEX trees_lying ON trees (collection) WHERE collection IS NOT NULL;
