// Included by every shader; nothing of it is used.
