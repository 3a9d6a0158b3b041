-- A file of posed's first format: named scenes, and no live one.
PRAGMA journal_mode=WAL;
PRAGMA user_version=1;
BEGIN TRANSACTION;
CREATE TABLE scene (name TEXT PRIMARY KEY, document TEXT NOT NULL) WITHOUT ROWID;
INSERT INTO scene VALUES('monday','{"format":"posed.scene/1","figures":{"body":{"template":"tempus","stature":1.75,"q":[0.0,0.0,0.9275,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,-0.6755902076156602,-0.0,-0.0,0.737277336810124,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,0.6755902076156602,0.0,0.0,0.737277336810124,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0]}},"goals":{"pelvis":{"figure":"body","kind":"position","at":"lower_torso","position":[0.0,0.0,0.9275],"relative_to":"world","weight":100.0,"priority":0,"tolerance":0.0,"enabled":true},"reach":{"figure":"body","kind":"position","at":"right_hand","position":[0.5,-0.3,1.2],"relative_to":"world","weight":10.0,"priority":0,"tolerance":0.01,"enabled":true,"label":"reach for the wheel","user":{"colour":"teal"}}},"objects":{},"bindings":{"b1":{"sensor":"simulated:1","to":{"goal":"reach"},"axes":["x","y","z"],"mode":"relative","scale":1.5,"label":"wand"}},"cameras":{}}');
INSERT INTO scene VALUES('empty','{"format":"posed.scene/1","figures":{},"goals":{},"objects":{},"bindings":{},"cameras":{}}');
COMMIT;
