-- Authors are known by the identifier of the user, whatever they are called.
UPDATE authors
SET person = (SELECT 'user ' || users.key FROM users WHERE 'login ' || users.folded = authors.person)
WHERE person LIKE 'login %';
