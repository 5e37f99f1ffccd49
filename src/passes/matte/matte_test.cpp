// Mattes
