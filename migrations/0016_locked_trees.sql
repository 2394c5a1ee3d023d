-- Who has locked a tree, so that owners alone change it.
ALTER TABLE trees ADD COLUMN locked_by TEXT;
