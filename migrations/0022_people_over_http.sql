-- Users and groups have identifiers by which addresses know them, whatever they are called, and are at a revision: how
-- often they were changed, and 1.
ALTER TABLE users ADD COLUMN key TEXT NOT NULL DEFAULT '';
ALTER TABLE users ADD COLUMN revision INTEGER NOT NULL DEFAULT 1;
UPDATE users SET key = lower(hex(randomblob(16)));
CREATE UNIQUE INDEX users_by_key ON users (key);

ALTER TABLE studios ADD COLUMN key TEXT NOT NULL DEFAULT '';
ALTER TABLE studios ADD COLUMN revision INTEGER NOT NULL DEFAULT 1;
UPDATE studios SET key = lower(hex(randomblob(16)));
CREATE UNIQUE INDEX studios_by_key ON studios (key);

-- Whose token it is: that of a user, as a login has one, or of the device that made it. It allows no more than they may.
ALTER TABLE passes ADD COLUMN maker TEXT REFERENCES passes (id) ON DELETE CASCADE;

CREATE INDEX passes_by_maker ON passes (maker) WHERE maker IS NOT NULL;
