"""The trade's parameters of surface texture: ISO 25178-2 of surfaces, ISO 21920-2 of profiles."""
